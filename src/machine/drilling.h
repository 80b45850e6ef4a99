// Drilling cycles: G81 to G83.
#pragma once

#include "moves.h"

namespace machine {

/// The cycle in force. lib/GCode works out its steps.
class Drilling {
 public:
  Drilling(gcode::Modal& modal, const Coordinates& coordinates, const ProgramPlace& program,
           const ZAxis& z, Moves& moves, Answers& answers, Waiting& waiting)
      : modal_(modal),
        coordinates_(coordinates),
        program_(program),
        z_(z),
        moves_(moves),
        answers_(answers),
        waiting_(waiting) {}

  /// Begins G81 to G83 by their number: the words of this line and of the next lines drill.
  void begin(uint8_t cycle);
  /// Drills the holes of a line.
  bool drill(const gcode::Words& words);

 private:
  bool refuse(gcode::DrillFault fault);
  bool runStep(const gcode::DrillStep& step);

  gcode::Modal& modal_;
  const Coordinates& coordinates_;
  const ProgramPlace& program_;
  const ZAxis& z_;
  Moves& moves_;
  Answers& answers_;
  Waiting& waiting_;
  gcode::Drilling cycle_;
};

}  // namespace machine
