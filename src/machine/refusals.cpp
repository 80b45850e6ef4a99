// Lines that are not done: an error where nothing depends on them, a halt where motion does.
//
// Clients do not stop for an `error:`. What follows a line of motion that was not done would start
// from a wrong place, so by default the machine halts ($70).
#include "machine.h"

namespace machine {
namespace {

bool isLetter(char c) { return c >= 'A' && c <= 'Z'; }

}  // namespace

void Machine::beginError() {
  out_ << FLASH("error: ");
  is_answered_ = true;
}

bool Machine::refuse(FlashText why) {
  beginError();
  out_.line(why);
  return false;
}

bool Machine::refuseMotion(FlashText why, char letter) {
  beginRefusal();
  out_ << why;
  if (letter != gcode::kNoLetter) out_ << letter;
  return endRefusal();
}

bool Machine::refuseCode(const gcode::Piece& piece) {
  beginRefusal();
  out_ << FLASH("this machine does no ") << piece.letter << int32_t(piece.tenths / 10);
  if (piece.tenths % 10 != 0) out_ << '.' << int32_t(piece.tenths % 10);
  return endRefusal();
}

void Machine::beginRefusal() {
  if (values_.at(kRefusedMotion) == 0)
    beginHalt();
  else
    beginError();
}

bool Machine::endRefusal() {
  if (values_.at(kRefusedMotion) == 0) return halt();
  out_.end();
  return false;
}

void Machine::beginHalt() {
  out_ << FLASH("ALARM: Halted at ");
  // As people write it: the spaces between words went when the line was read.
  for (const char* at = line_; *at != '\0'; ++at) {
    if (at != line_ && isLetter(*at) && !isLetter(at[-1]) && at[-1] != ' ') out_ << ' ';
    out_ << *at;
  }
  if (*line_ != '\0') out_ << FLASH(": ");
}

bool Machine::halt() {
  out_.line(FLASH(". Press Stop."));
  is_answered_ = true;
  lock_ = Lock::kHalted;
  input_.clear();
  // What was queued before is good: the path ends where the program meant it to.
  if (!drain()) return false;
  switchSpindle(false);
  return false;
}

bool Machine::refuseMistake(gcode::Mistake mistake) {
  using gcode::Fault;
  switch (mistake.fault) {
    case Fault::kNoNumber:
      return refuseMotion(FLASH("a number is missing behind "), mistake.letter);
    case Fault::kBadNumber:
      return refuseMotion(FLASH("what follows is no number: "), mistake.letter);
    case Fault::kTooLarge:
      return refuseMotion(FLASH("a number is far too large: "), mistake.letter);
    case Fault::kNoCode:
      return refuseMotion(FLASH("there is no such code: "), mistake.letter);
    default:
      return refuseMotion(FLASH("this begins no word: "), mistake.letter);
  }
}

}  // namespace machine
