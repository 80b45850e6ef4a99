// The computer's side: time, lines, and the dialogue step by step.
#include "player.h"

#include "line_match.h"

using world::Axis;

namespace {

const long kLongestGapMs = 1500;  // clients give up after 2 s of silence
const long kFirstLineMs = 500;    // after power came
const int kForEver = 1000000000;  // [ms]

bool startsWith(const std::string& text, const std::string& start) {
  return text.compare(0, start.size(), start) == 0;
}

/// What ^ and a letter stand for: ^X ctrl-X, ^N a line's end, ^M a return, ^H hold, ^J the end of a
/// jog, ^0 to ^9 and ^A to ^D the overrides.
char specialNamed(char name) {
  if (name >= '0' && name <= '9') return char(0x90 + (name - '0'));
  if (name >= 'A' && name <= 'D') return char(0x9a + (name - 'A'));
  if (name == 'M') return '\r';
  return name == 'X' ? '\x18' : name == 'H' ? '\x84' : name == 'J' ? '\x85' : '\n';
}

std::string rawOf(const std::string& text) {
  std::string raw;
  for (std::size_t i = 0; i < text.size(); ++i)
    raw += text[i] == '^' && i + 1 < text.size() ? specialNamed(text[++i]) : text[i];
  return raw;
}

}  // namespace

world::Parts partsOfDialogues() {
  world::Parts parts;
  // Coarser than usual, as hours are played.
  parts.motor_step = 5e-4;
  parts.hang_every = 0.1;
  for (const std::string side : {"left.", "right."}) {
    parts.numbers[side + "weight"] = 0.00137293;
    parts.numbers[side + "compliance"] = 5.2e-6;
  }
  return parts;
}

void Player::play() {
  start();
  while (at_ < steps_.size()) {
    brain_.advance(kForEver, [this] { return passMillisecond(); });
    if (!is_power_cut_) continue;
    brain_.cutPower(unsigned(answers_) % 256);
    start();
  }
  if (!lines_.empty()) fail("one line too many: " + lines_.front());
}

void Player::start() {
  is_power_cut_ = false;
  partial_.clear();
  lines_.clear();
  last_line_ms_ = now_ms_ - kLongestGapMs + kFirstLineMs;
  for (int axis = 0; axis < world::kAxisCount; ++axis) most_duty_[axis] = least_duty_[axis] = 0;
  brain_.start();
}

bool Player::passMillisecond() {
  ++now_ms_;
  hear();
  watchMotors();
  look();
  if (now_ms_ - last_line_ms_ > kLongestGapMs && !is_silence_allowed_ && !is_asked_for_)
    fail("silence");
  while (!is_power_cut_ && at_ < steps_.size() && takeStep(steps_[at_])) {
    ++at_;
    step_since_ms_ = now_ms_;
    question_.reset();
  }
  return is_power_cut_ || at_ == steps_.size();
}

void Player::hear() {
  for (const char character : brain_.takeSaid()) {
    if (character != '\n') {
      const auto code = uint8_t(character);
      if (code > 126 || (code < 32 && code != '\r')) fail("a character that is no ASCII text");
      partial_ += character;
      continue;
    }
    if (partial_.empty() || partial_.back() != '\r')
      fail("a line does not end in CR LF: " + partial_);
    partial_.pop_back();
    takeLine(partial_);
    partial_.clear();
  }
}

void Player::takeLine(const std::string& line) {
  last_line_ms_ = now_ms_;
  if (first_line_ms_ == 0) first_line_ms_ = now_ms_;
  if (startsWith(line, "<"))
    status_ = line, status_ms_ = now_ms_, is_asked_for_ = line.find('|') != std::string::npos;
  else if (startsWith(line, "[PE:"))
    errors_ = line;
  else
    lines_.push_back(line);
  if (line == "ok" || startsWith(line, "error:")) ++answers_;
  if (!startsWith(line, "ALARM: Halted")) return;
  ++halts_;
  // Its `ok` comes instead of the line's.
  if (stops_when_halted_) brain_.send("!\n");
}

void Player::watchMotors() {
  for (int axis = 0; axis < world::kAxisCount; ++axis) {
    const int duty = world_.duty(Axis(axis));
    if (duty != 0) driven_ms_[axis] = now_ms_;
    most_duty_[axis] = std::max(most_duty_[axis], duty);
    least_duty_[axis] = std::min(least_duty_[axis], duty);
  }
}

bool Player::takeStep(const Step& step) {
  switch (step.kind) {
    case Step::kSend:
      brain_.send(step.text + "\n");
      return true;
    case Step::kSendRaw:
      brain_.send(rawOf(step.text));
      return true;
    case Step::kExpect:
    case Step::kSkipTo:
      return expect(step);
    case Step::kAsk:
      return ask(step);
  }
  return false;
}

bool Player::expect(const Step& step) {
  while (!lines_.empty()) {
    const std::string line = lines_.front();
    lines_.pop_front();
    if (matches(line, readExpected(step.text))) return true;
    if (step.kind == Step::kExpect) fail("came instead: " + line);
  }
  if (now_ms_ - step_since_ms_ > kPatientMs) fail("it did not come");
  return false;
}

std::string Player::whereInTheScript() const {
  const Step& step = steps_[std::min(at_, steps_.size() - 1)];
  return step.place + ": " + step.text;
}

void Player::tellOr(bool holds, const std::string& what) const {
  if (!holds) fail(what);
}

void Player::fail(const std::string& why) const {
  throw Failure(whereInTheScript() + "\n  " + why + "\n  at " + std::to_string(now_ms_) + " ms; " +
                status_ + errors_);
}
