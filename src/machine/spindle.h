// Commands to spindle and laser, and the time that a spindle needs.
#pragma once

#include <GCode.h>

#include "cutter.h"
#include "printer.h"
#include "waiting.h"

namespace machine {

/// Switches the cutter, with messages to the operator, the servo and the wait.
class Spindle {
 public:
  Spindle(Cutter& cutter, Aux& aux, Printer& out, Waiting& waiting)
      : cutter_(cutter), aux_(aux), out_(out), waiting_(waiting) {}

  /// Returns when the spindle has gained or lost its speed.
  bool turn(bool on);
  bool isOn() const { return cutter_.isSpindleOn(); }
  /// Takes an S word; waits for queued moves where the speed of a turning spindle changes.
  bool takeS(const gcode::Words& words);
  /// M106 and M107.
  void switchLaser(bool on);

 private:
  bool turnServo(uint8_t angle);

  Cutter& cutter_;
  Aux& aux_;
  Printer& out_;
  Waiting& waiting_;
};

}  // namespace machine
