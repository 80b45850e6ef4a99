// Drilling cycles: G81 to G83.
#pragma once

#include "moves.h"

namespace machine {

/// The cycle in force. lib/GCode works out its steps.
class Drilling {
 public:
  explicit Drilling(Parts& parts) : parts_(parts) {}

  /// Begins G81 to G83 by their number; they apply to this line and those after it.
  void begin(uint8_t cycle);
  /// Drills the holes of a line.
  bool drill(const gcode::Words& words);

 private:
  bool refuse(gcode::DrillFault fault);
  bool runStep(const gcode::DrillStep& step);

  Parts& parts_;
  gcode::Drilling cycle_;
};

}  // namespace machine
