// The ring of waiting characters.
#include "input.h"

namespace gcode {
namespace {

const char kCtrlX = 24;
// Marks a line that was too long to keep. No client can send it: kept() replaces this character. It
// begins no word, so that in a hold the line waits as any line with a mistake.
const char kTooLong = 127;
// Replaces a byte that no line holds: in a comment it is harmless, elsewhere a mistake. No question
// mark of a client is stored outside comments.
const char kUnreadable = '?';

bool isControl(char character) { return uint8_t(character) < ' ' && character != '\t'; }

/// Whether Grbl senders use that byte, or its UTF-8 lead byte, as a command. No digit turns into
/// one of these by a single flipped bit.
bool isOfGrbl(uint8_t byte) { return (byte >= 0x80 && byte <= 0xa1) || byte == 0xc2; }

/// The character to store for an incoming character.
char kept(char character) {
  if (character == '\t') return ' ';
  return isControl(character) || uint8_t(character) > 126 ? kUnreadable : character;
}

}  // namespace

void Input::store(char character) {
  // Compared, not divided: a remainder costs 200 cycles.
  const uint16_t at = uint16_t(first_ + used_);
  ring_[at < kRoom ? at : at - kRoom] = character;
  ++used_;
}

Quick Input::quickOf(char character) {
  const uint8_t byte = uint8_t(character);
  if (byte == '!') return Quick::kStop;
  if (byte == '~') return Quick::kResume;
  if (byte == '`' || byte == kCtrlX) return Quick::kReset;
  if (isText()) return Quick::kNone;
  if (byte == '?') return Quick::kStatus;
  if (byte == 0x84) return Quick::kHold;
  if (byte == 0x85) return Quick::kJogCancel;
  if (byte < 0x90 || byte > 0x9d) return Quick::kNone;
  return Quick(uint8_t(Quick::kFeedUsual) + (byte - 0x90));
}

Quick Input::put(char character) {
  const Quick quick = quickOf(character);
  const bool after_quick = after_quick_;
  after_quick_ = quick != Quick::kNone && quick < Quick::kStatus;
  if (quick >= Quick::kStatus) return quick;
  if (quick == Quick::kResume) resumable_ = uint8_t(lines_ + 1);
  if (quick != Quick::kNone) return quick;
  if (after_return_ && line_ == Line::kBegins && (character == ' ' || character == '\n')) {
    after_return_ = character == ' ';
    return Quick::kNone;
  }
  after_return_ = character == '\r';
  if (character == '\n' || character == '\r') {
    // The end of the quick character, and of what it cut.
    if (!after_quick) return endLine();
    if (line_ == Line::kCut) line_ = Line::kBegins;
    return Quick::kNone;
  }
  if (!isText() && isOfGrbl(uint8_t(character))) return Quick::kNone;
  return take(character);
}

Quick Input::endLine() {
  const bool is_cut = line_ == Line::kCut;
  line_ = Line::kBegins;
  if (is_cut) return Quick::kNone;
  if (used_ == kRoom) return Quick::kOverflow;
  store('\n');
  ++lines_;
  return Quick::kNone;
}

Quick Input::take(char character) {
  switch (line_) {
    case Line::kTooLong:
    case Line::kCut:
      return Quick::kNone;
    case Line::kComment:
      if (character == ')') line_ = Line::kWords;
      return keep(kept(character));
    case Line::kRemark:
      return keep(kept(character));
    case Line::kBegins:
      // There may be noise from opening the port.
      if (isControl(character) || uint8_t(character) > 126) return Quick::kNone;
      break;
    default:
      break;
  }
  line_ = character == '(' ? Line::kComment : character == ';' ? Line::kRemark : Line::kWords;
  return keep(kept(character));
}

Quick Input::keep(char character) {
  // The last place is reserved for a line's end.
  const uint8_t most = lines_ == 0 ? uint8_t(kLongestLine) : uint8_t(kRoom - 1);
  if (used_ < most) {
    store(character);
    return Quick::kNone;
  }
  if (lines_ != 0) return Quick::kOverflow;
  used_ = 0;
  store(kTooLong);
  line_ = Line::kTooLong;
  return Quick::kNone;
}

bool Input::takeLine(char (&line)[kRoom + 1]) {
  if (lines_ == 0) return false;
  was_too_long_ = ring_[first_] == kTooLong;
  char* to = line;
  uint8_t at = first_;
  for (; ring_[at] != '\n'; at = after(at)) *to++ = ring_[at];
  *to = '\0';
  first_ = after(at);
  used_ = uint8_t(used_ - 1 - (to - line));
  --lines_;
  if (resumable_ != 0) --resumable_;
  return true;
}

bool Input::takeResume() {
  const bool came = resumable_ != 0;
  resumable_ = 0;
  return came;
}

void Input::clear() {
  first_ = used_ = lines_ = resumable_ = 0;
  if (line_ != Line::kBegins) line_ = Line::kCut;
}

}  // namespace gcode
