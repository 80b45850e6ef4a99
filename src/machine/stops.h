// Stops, halts and alarms.
#pragma once

#include "parts.h"
#include "yield_notice.h"

namespace machine {

/// What the operator has to do after an alarm.
enum class Remedy : uint8_t { kOpen, kLookForHold, kMendAndSet, kSwitchOff };

/// Stops the machine, by a character, a refusal or a fault, and says why.
class Stops {
 public:
  explicit Stops(Parts& parts) : parts_(parts) {}

  /// `!` or ctrl-X.
  void stop();
  /// A motion was refused: queued moves end first.
  void halt();
  /// To be called once a stop or an alarm has ended every command: finishes when everything stands.
  void finish();
  /// Says the texts and the remedy as one line.
  void raise(Remedy remedy, FlashText text, FlashText more = FLASH(""), FlashText last = FLASH(""));
  /// To be called often: faults become alarms.
  void watch();
  /// In place of the tick while the main program hangs.
  void noteHang();

 private:
  void forgetLines();
  void forgetUnanswered();
  void sayRemedy(Remedy remedy);
  void watchStack();
  void watchAxes();
  void watchEncoders();
  void raiseFault(Axes::AxisFault worst);

  Parts& parts_;
  YieldNotice yield_notice_;
  volatile bool hung_ = false;
};

}  // namespace machine
