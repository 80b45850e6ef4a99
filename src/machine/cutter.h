// Spindle and laser: what their pins show. It never waits; who switches a spindle waits for it.
#pragma once

#include <Settings.h>

#include "ports.h"
#include "settings_table.h"

namespace machine {

/// How the spindle is switched, by setting $17.
enum class SpindleKind : uint8_t { kNone, kServo, kRelayHigh, kRelayLow, kPulsed };

/// The two that cut.
///
/// The laser's strength travels with each move (beamOf), and the control tick shows it only while
/// that move is on its way: so it is off at rest, in a hold, in G0 and when set-points run dry,
/// whatever else happens. After off() nothing shows before the next arm().
class Cutter {
 public:
  Cutter(Aux& aux, const settings::Values& values) : aux_(aux), values_(values) {}

  SpindleKind kind() const { return SpindleKind(uint8_t(values_.at(kSpindle))); }
  /// Puts the spindle's pin on or off; a servo is turned by the caller.
  void setSpindle(bool on);
  /// Whether an S word changes how fast the spindle turns now.
  bool changesSpeed(float s) const {
    return is_turning_ && kind() == SpindleKind::kPulsed && s != s_;
  }
  /// Takes an S word: turns a minute, or of a laser 0 to 255.
  void takeS(float s);

  /// M106 and M107, for the moves that are queued from now on.
  void arm(bool yes);
  /// M106 without an S word is all the laser has.
  void setFull() { s_ = kFull; }
  /// The next move that is queued is one of G0 to G3; moves of other codes are not cut.
  void aim(uint8_t motion) { aimed_ = beamOf(motion); }
  /// How strong the laser is on the move that is being queued.
  uint8_t takeBeam();
  /// How strong it is on a move of G0 to G3.
  uint8_t beamOf(uint8_t motion) const;
  /// Shows what the move on its way asks for; called by the control tick.
  void show(uint8_t beam);

  /// All off, at once; may be called by an interrupt.
  void off();

 private:
  enum : uint8_t { kFull = 255 };

  uint8_t spindleLevel() const;

  Aux& aux_;
  const settings::Values& values_;
  float s_ = 0;
  volatile uint8_t shown_ = 0;
  volatile bool is_barred_ = true;
  uint8_t aimed_ = 0;
  bool is_armed_ = false, is_turning_ = false, is_pulsed_ = false;
};

}  // namespace machine
