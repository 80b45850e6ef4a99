// A cleaned line cut in front of each G and M; and first of all, whether anything in it is wrong.
#pragma once

#include "words.h"

namespace gcode {

const char kNoLetter = 0;

/// One command of a line: `G1 X5` or `M6 T1`, or words without one, `X5`.
struct Piece {
  char letter;      ///< G, M or kNoLetter
  uint16_t tenths;  ///< the code: 382 is G38.2
  Words words;
};

/// The first mistake in a line.
struct Mistake {
  Fault fault;
  char letter;
};

/// Looks at a whole line before any of it is run. Letters that mean nothing may stand without a
/// number; the others may not.
Mistake findMistake(const char* line);

/// The same for the words behind a B code, where letters in `bare` may stand alone: `B10 L`.
Mistake findMistake(const char* words, const char* bare);

/// The pieces of a line without mistakes, from left to right.
///
/// But for codes that need a place and have none: they wait for the words of a later piece, and
/// come behind it. `G28 G91 Z0` is G91, then G28 Z0; without that it would be two wrong moves.
class Pieces {
 public:
  explicit Pieces(const char* line) : at_(line) {}

  /// Reads the next one; false at the end.
  bool next(Piece& piece);

 private:
  bool read(Piece& piece);

  const char* at_;
  Piece waiting_;
  bool waits_ = false;   ///< waiting_ has no place yet
  bool is_due_ = false;  ///< it has, and is the next piece
};

}  // namespace gcode
