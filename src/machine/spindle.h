// Commands to spindle and laser, and the time that a spindle needs.
#pragma once

#include "basis.h"

namespace machine {

/// Switches the cutter, with messages to the operator, the servo and the wait.
class Spindle {
 public:
  explicit Spindle(Basis& basis) : base_(basis) {}

  /// Returns when the spindle has gained or lost its speed.
  bool turn(bool on);
  bool isOn() const { return base_.cutter.isSpindleOn(); }
  /// Takes an S word; waits for queued moves where the speed of a turning spindle changes.
  bool takeS(const gcode::Words& words);
  /// M106 and M107.
  void switchLaser(bool on);

 private:
  bool turnServo(uint8_t angle);

  Basis& base_;
};

}  // namespace machine
