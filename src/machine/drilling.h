// Drilling cycles: G81 to G83.
#pragma once

#include "moves.h"

namespace machine {

/// The cycle in force. lib/GCode works out its steps.
class Drilling {
 public:
  Drilling(Basis& basis, const Coordinates& coordinates, const ZAxis& z, Moves& moves)
      : base_(basis), coordinates_(coordinates), z_(z), moves_(moves) {}

  /// Begins G81 to G83 by their number: the words of this line and of the next lines drill.
  void begin(uint8_t cycle);
  /// Drills the holes of a line.
  bool drill(const gcode::Words& words);

 private:
  bool refuse(gcode::DrillFault fault);
  bool runStep(const gcode::DrillStep& step);

  Basis& base_;
  const Coordinates& coordinates_;
  const ZAxis& z_;
  Moves& moves_;
  gcode::Drilling cycle_;
};

}  // namespace machine
