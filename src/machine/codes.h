// G and M codes: a line is cut in front of each, and its pieces run from left to right.
#pragma once

#include "parts.h"

namespace machine {

/// Lines of programs.
class Codes {
 public:
  explicit Codes(Parts& parts) : parts_(parts) {}

  /// Runs a cleaned line.
  bool run(const char* text);
  /// Checks for mistakes and unknown codes without running anything.
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
  bool keepGoal(const gcode::Piece& piece) { return parts_.coordinates.keepGoal(piece); }
  bool goToKept(const gcode::Piece& piece) { return parts_.moves.goToKept(piece); }
  bool probe(const gcode::Piece& piece);
  bool takeToolLength(const gcode::Piece& piece) {
    return parts_.coordinates.takeToolLength(piece.words);
  }
  bool forgetToolLength(const gcode::Piece& piece);
  bool beginCycle(const gcode::Piece& piece);
  bool shift(const gcode::Piece& piece) { return parts_.coordinates.shift(piece.words); }
  bool endShift(const gcode::Piece& piece);
  bool pause(const gcode::Piece&) { return parts_.operator_lines.pauseAfterMoves(); }
  bool endProgram(const gcode::Piece&);
  bool startSpindle(const gcode::Piece& piece);
  bool stopSpindle(const gcode::Piece&) {
    return parts_.waiting.drain() && parts_.spindle.turn(false);
  }
  bool changeTool(const gcode::Piece& piece);
  bool armLaser(const gcode::Piece& piece);
  bool refuseSubprogram(const gcode::Piece&);

  Parts& parts_;
};

}  // namespace machine
