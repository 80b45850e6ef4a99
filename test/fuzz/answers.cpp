// The rules of the protocol about answers and lines.
#include "answers.h"

#include <cctype>

#include "must.h"

namespace {

const uint8_t kHold = 0x84;

bool startsWith(const std::string& text, const std::string& start) {
  return text.compare(0, start.size(), start) == 0;
}

/// Passes over a plain decimal number; false if there is none.
bool passNumber(const std::string& text, std::size_t& at) {
  if (at < text.size() && text[at] == '-') ++at;
  const std::size_t first = at;
  while (at < text.size() && (std::isdigit(uint8_t(text[at])) || text[at] == '.')) ++at;
  return at > first;
}

bool passNumbers(const std::string& text, std::size_t at, int count, const std::string& rest) {
  for (int i = 0; i < count; ++i) {
    if (!passNumber(text, at)) return false;
    if (i + 1 < count && text[at++] != ',') return false;
  }
  return text.compare(at, std::string::npos, rest) == 0;
}

/// Whether a line is one that Grbl senders know.
bool isKnownToGrbl(const std::string& line) {
  for (const char* start : {"ok", "error:", "ALARM:", "<", "[", "$", "Grbl 1.1"})
    if (startsWith(line, start)) return true;
  return false;
}

/// Whether a character gets an answer from a Maslow, and takes the line feed behind it.
bool isQuick(char character) {
  return character == '!' || character == '~' || character == '`' || character == '\x18';
}

/// Whether a line begins with a character, or goes on; no byte of a line is noise or a question.
bool beginsLine(char character) {
  return character == '\t' || (character >= ' ' && uint8_t(character) <= 126 && character != '?');
}

}  // namespace

void Answers::checkLine(const std::string& line) {
  const std::size_t place = line.find(":") + 1;
  if (is_of_grbl_) return must(isKnownToGrbl(line), "a line that no sender of Grbl knows: " + line);
  if (startsWith(line, "<"))
    must(line.find(",MPos:") != std::string::npos &&
             passNumbers(line, place, 3, ",WPos:0.000,0.000,0.000>"),
         "a status that clients cannot read: " + line);
  if (startsWith(line, "[PE:"))
    must(passNumbers(line, place, 3, "]"), "errors that clients cannot read: " + line);
  if (startsWith(line, "[Measure: "))
    must(passNumbers(line, 10, 1, "]"), "a measurement that clients cannot read: " + line);
}

void Answers::taken(char character) {
  // The end of line right behind a quick character is that character's.
  const bool follows_quick = after_quick_;
  after_quick_ = isQuick(character);
  // GroundControl puts a space behind each line: then the only `?` so far was noise, and the line
  // turns the dialect back once it is done.
  const bool ends = character == '\n' || character == '\r';
  if (ends && has_space_ && is_of_grbl_ && !is_sure_) is_unclear_ = true;
  has_space_ = character == ' ' || character == '\t';
  if (character == '?' && !is_in_line_) {
    // A Maslow client had no answers after an alarm.
    if (!is_of_grbl_ && is_locked_) broken_ = lines_ + quick_ - answered_;
    is_sure_ = is_of_grbl_;
    is_of_grbl_ = true;
    return;
  }
  // CR ends a line too; what may follow it is part of that end.
  const bool follows_return = after_return_ && !is_in_line_;
  after_return_ = character == '\r' || (follows_return && character == ' ');
  if (follows_return && (character == ' ' || character == '\n')) return;
  if (is_of_grbl_ && (after_quick_ || uint8_t(character) == kHold))
    takenByGrbl(character);
  else if (after_quick_)
    takenQuick(character);
  else if (ends)
    takenEnd(follows_quick);
  else if (beginsLine(character))
    is_in_line_ = true;
  // In a comment it is text: then lines are answered, which is allowed.
  if (uint8_t(character) == kHold) is_held_ = true;
  if (uint8_t(character) == kHold || after_quick_) is_idle_ = false;
}

void Answers::takenEnd(bool follows_quick) {
  if (!follows_quick && !is_cut_) ++lines_;
  if (!follows_quick || is_cut_) is_in_line_ = false;
  is_cut_ = false;
}

void Answers::takenQuick(char character) {
  if (character != '~') {
    dropLines();
    is_locked_ = false;
  }
  ++(character == '~' && is_held_ ? resumed_ : quick_);
  is_held_ = false;
}

void Answers::takenByGrbl(char character) {
  is_idle_ = false;
  is_held_ = character == '!' || uint8_t(character) == kHold;
  if (character != '`' && character != '\x18') return;
  dropLines();
  is_locked_ = is_waiting_ = false;
}

void Answers::dropLines() {
  lines_ = answered_ - quick_;
  resumed_ = broken_ = 0;
  is_cut_ = is_in_line_;
}

void Answers::said(const std::string& line) {
  if (is_unclear_) return;
  // B05 is echoed once it has turned the dialect off.
  if (startsWith(line, "B05")) is_of_grbl_ = false;
  // The answers to $I, $G and $X, which turn it on: what came since may have no answer.
  for (const char* greeting : {"[VER:", "[GC:", "[MSG:Caution: Unlocked]"}) {
    if (is_of_grbl_ || !startsWith(line, greeting)) continue;
    broken_ = lines_ + quick_ - answered_;
    is_of_grbl_ = true;
  }
  checkLine(line);
  if (is_of_grbl_)
    saidToGrbl(line);
  else
    saidToMaslow(line);
  const std::size_t equals = line.find('=');
  if (startsWith(line, "$") && equals != std::string::npos && std::isdigit(uint8_t(line[1]))) {
    std::size_t at = equals + 1;
    must(passNumber(line, at), "a setting that clients cannot read: " + line);
    ++settings_;
  }
}

void Answers::saidToGrbl(const std::string& line) {
  if (line == "ok" || startsWith(line, "error:")) {
    ++answered_;
    must(answered_ <= lines_ + quick_ + resumed_, "an answer too many: " + line);
  }
  if (startsWith(line, "ALARM:")) {
    ++broken_;
    is_locked_ = true;
    is_halted_ = line == "ALARM:2";
  }
  if (startsWith(line, "[MSG:Halted at ")) is_locked_ = is_halted_ = true;
  if (line == "[MSG:Caution: Unlocked]") is_locked_ = false;
  if (line == "[MSG:Maslow Paused]") is_waiting_ = true;
  if (!startsWith(line, "<")) return;
  is_idle_ = startsWith(line, "<Idle|");
  is_waiting_ = startsWith(line, "<Hold:");
}

void Answers::saidToMaslow(const std::string& line) {
  if (line == "ok" || startsWith(line, "error:")) {
    ++answered_;
    must(answered_ <= lines_ + quick_ + resumed_, "an answer too many: " + line);
  }
  if (startsWith(line, "ALARM:") && !startsWith(line, "ALARM: Position Lost")) {
    dropLines();
    is_locked_ = true;
    is_idle_ = false;
    is_halted_ = startsWith(line, "ALARM: Halted at ");
  }
  if (startsWith(line, "<")) {
    is_idle_ = startsWith(line, "<Idle,");
    is_waiting_ = startsWith(line, "<Pause,");
  }
  if (startsWith(line, "Z goes back to ")) is_waiting_ = true;
  if (startsWith(line, "FAKE_SERVO ")) is_simulated_ = line == "FAKE_SERVO on";
}

void Answers::wentRound() {
  if (is_unclear_) return;
  const int kMostRounds = 4;
  const bool may_wait = is_locked_ || is_held_ || is_waiting_;
  const bool waits = !isComplete() && !may_wait && answered_ == answered_before_;
  rounds_ = waits ? rounds_ + 1 : 0;
  answered_before_ = answered_;
  must(rounds_ <= kMostRounds, "a line was never answered");
}

int Answers::takeSettings() {
  const int count = settings_;
  settings_ = 0;
  return count;
}
