// Levels of the pins of spindle and laser. Nothing here waits: the caller waits for the spindle.
#pragma once

#include <Settings.h>

#include "ports.h"
#include "settings_table.h"

namespace machine {

/// How the spindle is switched, by setting $17.
enum class SpindleKind : uint8_t { kNone, kServo, kRelayHigh, kRelayLow, kPulsed };

/// Spindle and laser.
///
/// Each move carries the laser's strength (beamOf), and the control tick puts it on the pin only
/// during that move. So the laser is off at rest, in a hold, in G0 and when set-points run dry.
/// After off() it stays off until the next arm().
class Cutter {
 public:
  Cutter(Aux& aux, const settings::Values& values) : aux_(aux), values_(values) {}

  SpindleKind kind() const { return SpindleKind(uint8_t(values_.at(kSpindle))); }
  /// Switches the spindle's pin on or off. The caller turns a servo.
  void setSpindle(bool on);
  bool isSpindleOn() const { return is_turning_; }
  /// Whether an S word changes the speed of the turning spindle.
  bool changesSpeed(float s) const {
    return is_turning_ && kind() == SpindleKind::kPulsed && s != s_;
  }
  /// Takes an S word: turns a minute, or 0 to 255 for a laser.
  void takeS(float s);
  /// The S word in force.
  float s() const { return s_; }
  /// From now on a pulsed spindle turns at this percentage of S, within its limits.
  void override(uint8_t percent);

  bool isArmed() const { return is_armed_; }
  /// M106 and M107, for moves that are queued from now on.
  void arm(bool yes);
  /// M106 without an S word: full strength.
  void setFull() { s_ = kFull; }
  /// Says that the next move to be queued is one of G0 to G3. Moves of other codes do not cut.
  void aim(uint8_t motion) { aimed_ = beamOf(motion); }
  /// Strength of the laser on the move that is being queued.
  uint8_t takeBeam();
  /// Strength of the laser on a move of G0 to G3.
  uint8_t beamOf(uint8_t motion) const;
  /// Puts the strength of the move in progress on the pin. The control tick calls it.
  void show(uint8_t beam);

  /// Switches everything off at once. An interrupt may call it.
  void off();

 private:
  enum : uint8_t { kFull = 255 };

  uint8_t spindleLevel() const;

  Aux& aux_;
  const settings::Values& values_;
  float s_ = 0;
  volatile uint8_t shown_ = 0;
  volatile bool is_barred_ = true;
  uint8_t aimed_ = 0, percent_ = 100;
  bool is_armed_ = false, is_turning_ = false, is_pulsed_ = false;
};

}  // namespace machine
