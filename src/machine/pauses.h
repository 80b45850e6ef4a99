// Pauses: M0, tool changes, the z axis that is set by hand; all wait for `~`.
#pragma once

#include "operator_lines.h"
#include "spindle.h"

namespace machine {

/// Each waits for queued moves and for the end of a hold first, and returns false after a stop.
class Pauses {
 public:
  explicit Pauses(Parts& parts) : parts_(parts) {}

  /// M0 and M1.
  bool pauseAfterMoves();
  /// M6.
  bool changeTool(uint16_t tool);
  /// Asks the operator to bring z to a height [mm]; afterwards z counts as there. The spindle
  /// stands meanwhile, unless the bit goes into the work.
  bool setZByHand(float z, bool into_work);

 private:
  bool pause();

  Parts& parts_;
};

}  // namespace machine
