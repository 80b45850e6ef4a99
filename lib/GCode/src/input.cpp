// The ring of waiting characters.
#include "input.h"

namespace gcode {
namespace {

const char kCtrlX = 24;
// Stands for a line of which nothing is left; no client can send it, as control characters are
// dropped.
const char kTooLong = 1;
// Stands for a byte that is no ASCII, in a comment or, where it is a mistake, outside; the question
// mark itself is never stored.
const char kUnreadable = '?';

/// What is kept of a character.
char kept(char character) {
  if (character == '\t') return ' ';
  return uint8_t(character) > 126 ? kUnreadable : character;
}

}  // namespace

void Input::store(char character) {
  ring_[uint8_t((uint16_t(first_) + used_) % kRoom)] = character;
  ++used_;
}

Quick Input::put(char character) {
  const bool after_quick = after_quick_;
  after_quick_ = character == '!' || character == '~' || character == '`' || character == kCtrlX;
  if (character == '!') return Quick::kStop;
  if (character == '~') {
    resumable_ = uint8_t(lines_ + 1);
    return Quick::kResume;
  }
  if (after_quick_) return Quick::kReset;
  if (character == '\n') {
    if (after_quick) return Quick::kNone;
    swallowing_ = false;
    if (used_ == kRoom) return Quick::kOverflow;
    store('\n');
    ++lines_;
    return Quick::kNone;
  }
  const bool is_control = uint8_t(character) < 32 && character != '\t';
  if (swallowing_ || character == '?' || is_control) return Quick::kNone;
  // The last place is kept for a line's end.
  if (used_ < kRoom - 1) {
    store(kept(character));
    return Quick::kNone;
  }
  if (lines_ != 0) return Quick::kOverflow;
  used_ = 0;
  store(kTooLong);
  swallowing_ = true;
  return Quick::kNone;
}

bool Input::takeLine(char (&line)[kRoom + 1]) {
  if (lines_ == 0) return false;
  --lines_;
  if (resumable_ != 0) --resumable_;
  uint8_t length = 0;
  for (;;) {
    const char character = ring_[first_];
    first_ = uint8_t((uint16_t(first_) + 1) % kRoom);
    --used_;
    if (character == '\n') break;
    line[length++] = character;
  }
  line[length] = '\0';
  was_too_long_ = length == 1 && line[0] == kTooLong;
  return true;
}

bool Input::takeResume() {
  const bool came = resumable_ != 0;
  resumable_ = 0;
  return came;
}

void Input::clear() {
  first_ = used_ = lines_ = resumable_ = 0;
  swallowing_ = false;
}

}  // namespace gcode
