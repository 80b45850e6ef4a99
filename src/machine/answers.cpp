// The texts of refusals.
#include "answers.h"

namespace machine {
namespace {

bool isLetter(char c) { return c >= 'A' && c <= 'Z'; }

FlashText textOf(gcode::Fault fault) {
  using gcode::Fault;
  switch (fault) {
    case Fault::kNoNumber:
      return FLASH("a number is missing behind ");
    case Fault::kBadNumber:
      return FLASH("what follows is no number: ");
    case Fault::kTooLarge:
      return FLASH("a number is far too large: ");
    case Fault::kNoCode:
      return FLASH("there is no such code: ");
    default:
      return FLASH("this begins no word: ");
  }
}

uint8_t numberOf(gcode::Fault fault) {
  using gcode::Fault;
  if (fault == Fault::kStray) return grbl::kNoLetter;
  return fault == Fault::kNoCode ? grbl::kUnsupported : grbl::kBadNumber;
}

}  // namespace

FlashText tooLongForChains() { return FLASH("no chain is that long"); }
FlashText tooLongForZ() { return FLASH("no z axis is that long"); }
FlashText tooLongALine() { return FLASH("a line of more than 126 characters, which was skipped"); }
FlashText tooFar() { return FLASH("that is farther than any machine reaches"); }

void Answers::beginError(uint8_t number) {
  out_.error(number);
  is_answered_ = true;
}

bool Answers::refuse(FlashText why, uint8_t number) {
  beginError(number);
  out_.line(why);
  return false;
}

bool Answers::refuseBare(uint8_t number) {
  out_.bareError(number);
  is_answered_ = true;
  return false;
}

bool Answers::refuseStatement() { return refuse(FLASH("Invalid statement")); }

bool Answers::refuseLine(bool is_motion, uint8_t number, FlashText why, char letter) {
  beginRefusal(is_motion, number);
  out_ << why;
  if (letter != '\0') out_ << letter;
  return endRefusal();
}

bool Answers::refuseMotion(FlashText why, float mm, FlashText more) {
  beginRefusal(true, grbl::kTravel);
  out_ << why;
  out_.fixed(mm, 0) << more;
  return endRefusal();
}

bool Answers::refuseCode(const gcode::Piece& piece) {
  beginRefusal(false, grbl::kUnsupported);
  out_ << FLASH("this machine does no ") << piece.letter << int32_t(piece.tenths / 10);
  if (piece.tenths % 10 != 0) out_ << '.' << int32_t(piece.tenths % 10);
  return endRefusal();
}

bool Answers::refuseMistake(gcode::Mistake mistake) {
  return refuseLine(false, numberOf(mistake.fault), textOf(mistake.fault), mistake.letter);
}

/// Begins the text. A halt is an alarm, but to a Grbl sender a mistake in a line stays an error.
void Answers::beginRefusal(bool is_motion, uint8_t number) {
  if (halts() && (is_motion || !out_.speaksGrbl()))
    out_.alarm(grbl::kAlarmOfTarget);
  else
    out_.error(number);
  if (halts()) quoteLine();
}

bool Answers::endRefusal() {
  if (halts()) out_ << FLASH(". ") << out_.toOpen() << '.';
  out_.end();
  must_halt_ = halts();
  is_answered_ = true;
  return false;
}

void Answers::quoteLine() {
  out_ << FLASH("Halted at ");
  // With the spaces that reading removed.
  for (const char* at = line_; *at != '\0'; ++at) {
    if (at != line_ && isLetter(*at) && *at != 'E' && !isLetter(at[-1]) && at[-1] != ' ')
      out_ << ' ';
    out_ << *at;
  }
  if (*line_ != '\0') out_ << FLASH(": ");
}

}  // namespace machine
