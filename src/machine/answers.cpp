// The words of refusals.
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

}  // namespace

FlashText tooLongForChains() { return FLASH("no chain is that long"); }
FlashText tooLongForZ() { return FLASH("no z axis is that long"); }
FlashText tooLongALine() { return FLASH("a line of more than 126 characters, which was skipped"); }
FlashText tooFar() { return FLASH("that is farther than any machine reaches"); }

void Answers::beginError() {
  out_ << FLASH("error: ");
  is_answered_ = true;
}

bool Answers::refuse(FlashText why) {
  beginError();
  out_.line(why);
  return false;
}

bool Answers::refuseStatement() { return refuse(FLASH("Invalid statement")); }

bool Answers::refuseMotion(FlashText why) {
  beginRefusal();
  out_ << why;
  return endRefusal();
}

bool Answers::refuseMotion(FlashText why, char letter) {
  beginRefusal();
  out_ << why << letter;
  return endRefusal();
}

bool Answers::refuseMotion(FlashText why, float mm, FlashText more) {
  beginRefusal();
  out_ << why;
  out_.fixed(mm, 0) << more;
  return endRefusal();
}

bool Answers::refuseCode(const gcode::Piece& piece) {
  beginRefusal();
  out_ << FLASH("this machine does no ") << piece.letter << int32_t(piece.tenths / 10);
  if (piece.tenths % 10 != 0) out_ << '.' << int32_t(piece.tenths % 10);
  return endRefusal();
}

bool Answers::refuseMistake(gcode::Mistake mistake) {
  return refuseMotion(textOf(mistake.fault), mistake.letter);
}

void Answers::beginRefusal() {
  if (halts())
    beginHalt();
  else
    beginError();
}

bool Answers::endRefusal() {
  out_.line(halts() ? FLASH(". Press Stop.") : FLASH(""));
  must_halt_ = halts();
  is_answered_ = true;
  return false;
}

void Answers::beginHalt() {
  out_ << FLASH("ALARM: Halted at ");
  // As people write it: reading removed the spaces between words.
  for (const char* at = line_; *at != '\0'; ++at) {
    if (at != line_ && isLetter(*at) && *at != 'E' && !isLetter(at[-1]) && at[-1] != ' ')
      out_ << ' ';
    out_ << *at;
  }
  if (*line_ != '\0') out_ << FLASH(": ");
}

}  // namespace machine
