// A cleaned line cut in front of each G and M, and a check of the whole line before that.
#pragma once

#include "words.h"

namespace gcode {

const char kNoLetter = 0;

/// A command of a line: `G1 X5` or `M6 T1`, or words without a command, `X5`.
struct Piece {
  char letter;      ///< G, M or kNoLetter
  uint16_t tenths;  ///< ten times the code: 382 is G38.2
  Words words;
};

/// The first mistake in a line.
struct Mistake {
  Fault fault;
  char letter;
};

/// Checks a whole line before any of it is run. Letters that mean nothing may stand without a
/// number; all others need a number.
Mistake findMistake(const char* line);

/// Checks the words behind a B code, where letters in `bare` may stand alone: `B10 L`.
Mistake findMistake(const char* words, const char* bare);

/// The pieces of a line without mistakes, from left to right.
///
/// A code that needs a place and has none waits for the words of a later piece, and comes after
/// it. `G28 G91 Z0` is G91, then G28 Z0; from left to right it would be two wrong moves.
class Pieces {
 public:
  explicit Pieces(const char* line) : at_(line) {}

  /// Reads the next piece; false at the end.
  bool next(Piece& piece);

 private:
  bool read(Piece& piece);

  const char* at_;
  Piece waiting_;
  bool waits_ = false;   ///< `waiting_` has no place yet
  bool is_due_ = false;  ///< `waiting_` has its place, and is the next piece
};

}  // namespace gcode
