// Pauses: M0, tool changes, the z axis that is set by hand; all wait for `~`.
#pragma once

#include "operator_lines.h"
#include "sled_place.h"
#include "spindle.h"

namespace machine {

/// Each waits for queued moves and for the end of a hold first, and returns false after a stop.
class Pauses {
 public:
  Pauses(OperatorLines& operator_lines, gcode::Input& input, gcode::Modal& modal, Spindle& spindle,
         SledPlace& place, Printer& out, Waiting& waiting)
      : operator_lines_(operator_lines),
        input_(input),
        modal_(modal),
        spindle_(spindle),
        place_(place),
        out_(out),
        waiting_(waiting) {}

  /// M0 and M1.
  bool pauseAfterMoves();
  /// M6.
  bool changeTool(uint16_t tool);
  /// Asks the operator to bring z to a height [mm]; afterwards z counts as there. The spindle
  /// stands meanwhile, unless the bit goes into the work.
  bool setZByHand(float z, bool into_work);

 private:
  bool pause();

  OperatorLines& operator_lines_;
  gcode::Input& input_;
  gcode::Modal& modal_;
  Spindle& spindle_;
  SledPlace& place_;
  Printer& out_;
  Waiting& waiting_;
};

}  // namespace machine
