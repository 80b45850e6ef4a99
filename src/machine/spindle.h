// Commands to spindle and laser, and the time that a spindle needs.
#pragma once

#include <GCode.h>

namespace machine {

struct Parts;

/// Switches the cutter, with messages to the operator, the servo and the wait.
class Spindle {
 public:
  explicit Spindle(Parts& parts) : parts_(parts) {}

  /// Returns when the spindle has gained or lost its speed.
  bool turn(bool on);
  /// Takes an S word; waits for queued moves where the speed of a turning spindle changes.
  bool takeS(const gcode::Words& words);
  /// M106 and M107.
  void switchLaser(bool on);

 private:
  bool turnServo(uint8_t angle);

  Parts& parts_;
};

}  // namespace machine
