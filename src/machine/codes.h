// G and M codes: a line is cut in front of each, and its pieces run from left to right.
#pragma once

#include "drilling.h"
#include "new_values.h"
#include "overrides.h"
#include "single_axis.h"

namespace machine {

/// Lines of programs.
class Codes {
 public:
  Codes(Basis& basis, LiveOverrides& overrides, Spindle& spindle, ZAxis& z, NewValues& new_values,
        Coordinates& coordinates, Pauses& pauses, Moves& moves, Drilling& drilling,
        SingleAxis& single_axis)
      : base_(basis),
        overrides_(overrides),
        spindle_(spindle),
        z_(z),
        new_values_(new_values),
        coordinates_(coordinates),
        pauses_(pauses),
        moves_(moves),
        drilling_(drilling),
        single_axis_(single_axis) {}

  /// Does a line, which is clean.
  bool run(const char* text);
  /// Looks for mistakes and for codes that this machine does not know; nothing is done.
  bool check(const char* text);

 private:
  typedef bool (Codes::*Run)(const gcode::Piece& piece);
  struct Code;

  bool runPiece(const gcode::Piece& piece);
  bool moveInMode(const gcode::Words& words);
  bool riseAfterCycle(const gcode::Words& words);
  bool setTool(const gcode::Words& words);
  static bool find(const gcode::Piece& piece, Code& found);
  bool runOwn(const gcode::Piece& piece);
  bool ignoreM(const gcode::Piece& piece);
  bool beginMotion(const gcode::Piece& piece);
  bool dwell(const gcode::Piece& piece);
  bool declare(const gcode::Piece& piece);
  bool keepGoal(const gcode::Piece& piece) { return coordinates_.keepGoal(piece); }
  bool goToKept(const gcode::Piece& piece) { return moves_.goToKept(piece); }
  bool probe(const gcode::Piece& piece);
  bool takeToolLength(const gcode::Piece& piece) {
    return coordinates_.takeToolLength(piece.words);
  }
  bool forgetToolLength(const gcode::Piece& piece);
  bool beginCycle(const gcode::Piece& piece);
  bool shift(const gcode::Piece& piece) { return coordinates_.shift(piece.words); }
  bool endShift(const gcode::Piece& piece);
  bool pause(const gcode::Piece&) { return pauses_.pauseAfterMoves(); }
  bool endProgram(const gcode::Piece&);
  bool startSpindle(const gcode::Piece& piece);
  bool stopSpindle(const gcode::Piece&) { return base_.waiting.drain() && spindle_.turn(false); }
  bool changeTool(const gcode::Piece& piece);
  bool armLaser(const gcode::Piece& piece);
  bool refuseSubprogram(const gcode::Piece&);

  Basis& base_;
  LiveOverrides& overrides_;
  Spindle& spindle_;
  ZAxis& z_;
  NewValues& new_values_;
  Coordinates& coordinates_;
  Pauses& pauses_;
  Moves& moves_;
  Drilling& drilling_;
  SingleAxis& single_axis_;
};

}  // namespace machine
