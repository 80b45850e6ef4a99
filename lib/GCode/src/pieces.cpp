// Where a line is cut, and which of its letters mean anything.
#include "pieces.h"

#include <math.h>

namespace gcode {
namespace {

const float kMostCode = 999;

bool holds(const char* letters, char letter) {
  for (; *letters != '\0'; ++letters)
    if (*letters == letter) return true;
  return false;
}

/// Letters of which a number is used.
bool hasMeaning(char letter) {
  return (letter >= 'F' && letter <= 'M') || (letter >= 'P' && letter <= 'T') || letter >= 'X';
}

/// Codes that take the place words of their line, wherever in the line they come.
bool claimsPlace(const Piece& piece) {
  if (piece.letter != 'G') return false;
  switch (piece.tenths) {
    case 100:
    case 280:
    case 300:
    case 382:
    case 431:
    case 920:
      return true;
    default:
      return false;
  }
}

/// Moves the words for a place, and the words that go with it, from a piece to another.
void movePlace(Words& from, Words& to) {
  for (const char* letter = "XYZLPR"; *letter != '\0'; ++letter) {
    if (!from.has(*letter)) continue;
    to.add(*letter, from.value(*letter));
    from.remove(*letter);
  }
}

bool isAnyCode(float code) {
  const float kRounding = 0.01f;
  return code >= 0 && code <= kMostCode &&
         float(fabs(code * 10 - float(lround(code * 10)))) < kRounding;
}

}  // namespace

Mistake findMistake(const char* line) {
  Word word;
  bool is_subroutine = false;
  while (checkWord(line, word)) {
    // `O1000` alone is a program's number; `O100 CALL` would be a jump.
    if (is_subroutine) return {Fault::kNoCode, 'O'};
    is_subroutine = word.letter == 'O';
    if (word.fault == Fault::kNoNumber && !hasMeaning(word.letter)) continue;
    if (word.fault != Fault::kNone) return {word.fault, word.letter};
    if (isCode(word.letter) && !isAnyCode(word.value)) return {Fault::kNoCode, word.letter};
  }
  return {Fault::kNone, kNoLetter};
}

Mistake findMistake(const char* words, const char* bare) {
  Word word;
  while (checkWord(words, word)) {
    if (word.fault == Fault::kNoNumber && holds(bare, word.letter)) continue;
    if (word.fault != Fault::kNone) return {word.fault, word.letter};
  }
  return {Fault::kNone, kNoLetter};
}

bool Pieces::next(Piece& piece) {
  if (is_due_) {
    is_due_ = false;
    piece = waiting_;
    return true;
  }
  while (read(piece)) {
    if (waits_) {
      is_due_ = piece.words.hasPlace();
      waits_ = !is_due_;
      if (is_due_) movePlace(piece.words, waiting_.words);
      return true;
    }
    if (!claimsPlace(piece) || piece.words.hasPlace()) return true;
    waiting_ = piece;
    waits_ = true;
  }
  piece = waiting_;
  const bool waited = waits_;
  waits_ = false;
  return waited;
}

bool Pieces::read(Piece& piece) {
  piece.letter = kNoLetter;
  piece.tenths = 0;
  piece.words.clear();
  Word word;
  for (const char* before = at_; readWord(at_, word); before = at_) {
    if (!isCode(word.letter)) {
      // A line's number means nothing.
      if (word.letter != 'N' && word.fault == Fault::kNone)
        piece.words.add(word.letter, word.value);
      continue;
    }
    if (piece.letter != kNoLetter || !piece.words.isEmpty()) {
      at_ = before;
      return true;
    }
    piece.letter = word.letter;
    piece.tenths = uint16_t(lround(word.value * 10));
  }
  return piece.letter != kNoLetter || !piece.words.isEmpty();
}

}  // namespace gcode
