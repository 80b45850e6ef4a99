// The ring of waiting characters.
#include "input.h"

namespace gcode {
namespace {

const char kCtrlX = 24;
// Marks a line that was too long to keep. No client can send it: kept() replaces this character. It
// begins no word, so that in a hold the line waits as any line with a mistake.
const char kTooLong = 127;
// Replaces a byte that no line holds: in a comment it is harmless, elsewhere a mistake. A question
// mark from the client is never stored.
const char kUnreadable = '?';

bool isControl(char character) { return uint8_t(character) < ' ' && character != '\t'; }

/// The character that is stored for a character.
char kept(char character) {
  if (character == '\t') return ' ';
  return isControl(character) || uint8_t(character) > 126 ? kUnreadable : character;
}

}  // namespace

void Input::store(char character) {
  ring_[uint8_t((uint16_t(first_) + used_) % kRoom)] = character;
  ++used_;
}

bool Input::isInLine() const {
  return used_ != 0 && ring_[uint8_t((uint16_t(first_) + used_ - 1) % kRoom)] != '\n';
}

/// What a byte above 127 asks for. It asks for nothing in a comment or in a letter in UTF-8, whose
/// first byte is above 127 too.
Quick Input::putQuick(char character) {
  const uint8_t byte = uint8_t(character);
  const bool is_text = comment_ != 0 || after_text_;
  const bool is_quick = byte == 0x84 || (byte >= 0x90 && byte <= 0x94);
  after_text_ = byte > 127 && (is_text || !is_quick);
  if (character == '\n' || (character == ')' && comment_ == '('))
    comment_ = 0;
  else if (comment_ == 0 && (character == '(' || character == ';'))
    comment_ = character;
  if (is_text || !is_quick) return Quick::kNone;
  if (byte == 0x84) return Quick::kHold;
  return Quick(uint8_t(Quick::kFeedUsual) + (byte - 0x90));
}

Quick Input::put(char character) {
  const Quick quick = putQuick(character);
  if (quick != Quick::kNone) return quick;
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
    swallowing_ = after_return_ = false;
    if (used_ == kRoom) return Quick::kOverflow;
    store('\n');
    ++lines_;
    return Quick::kNone;
  }
  // In front of a line there may be noise, from the moment when the port was opened.
  if (character == '?' || (isControl(character) && !isInLine())) return Quick::kNone;
  if (character == '\r') {
    after_return_ = true;
    return Quick::kNone;
  }
  if (after_return_ && kept(character) != ' ') {
    after_return_ = false;
    keep(kUnreadable);
  }
  return keep(kept(character));
}

Quick Input::keep(char character) {
  if (swallowing_) return Quick::kNone;
  // The last place is reserved for a line's end.
  if (used_ < kRoom - 1) {
    store(character);
    return Quick::kNone;
  }
  if (lines_ != 0) return Quick::kOverflow;
  used_ = 0;
  store(kTooLong);
  swallowing_ = true;
  return Quick::kNone;
}

bool Input::peekLine(char (&line)[kRoom + 1]) const {
  if (lines_ == 0) return false;
  uint8_t length = 0;
  for (uint8_t at = first_;; at = uint8_t(at + 1)) {
    if (at == kRoom) at = 0;
    if (ring_[at] == '\n') break;
    line[length++] = ring_[at];
  }
  line[length] = '\0';
  return true;
}

void Input::dropLine() {
  was_too_long_ = ring_[first_] == kTooLong;
  char dropped;
  do {
    dropped = ring_[first_];
    first_ = uint8_t((uint16_t(first_) + 1) % kRoom);
    --used_;
  } while (dropped != '\n');
  --lines_;
  if (resumable_ != 0) --resumable_;
}

bool Input::takeLine(char (&line)[kRoom + 1]) {
  if (!peekLine(line)) return false;
  dropLine();
  return true;
}

bool Input::takeResume() {
  const bool came = resumable_ != 0;
  resumable_ = 0;
  return came;
}

void Input::clear() {
  first_ = used_ = lines_ = resumable_ = 0;
  swallowing_ = after_return_ = false;
  comment_ = 0;
}

}  // namespace gcode
