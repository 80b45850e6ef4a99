// The board's side of the stage: time, wire, motors; and the dialogue, step by step.
#include "stage.h"

#include <cmath>

using namespace machine;

namespace {

const double kBytesPerMs = 5.88;  // 58,824 baud, ten bits each
const int kTickMs = 10;
const long kPatienceMs = 150000;  // for a line that is expected
const long kLongestGapMs = 1500;  // clients give up after 2 s of silence
const int kOutRoom = 255;

const double kMainPerCount = 63.5 / 8113.73, kZPerCount = 3.17 / 7560;  // [mm]
const double kMainTopSpeed = 26, kZTopSpeed = 1.1;                      // [mm/s]

bool startsWith(const std::string& text, const std::string& start) {
  return text.compare(0, start.size(), start) == 0;
}

/// What ^ and a letter stand for: ^X ctrl-X, ^N a line's end, ^H hold, ^0 to ^4 the feed override.
char specialNamed(char name) {
  if (name >= '0' && name <= '4') return char(0x90 + (name - '0'));
  return name == 'X' ? '\x18' : name == 'H' ? '\x84' : '\n';
}

}  // namespace

Stage::Stage(std::vector<Step> steps)
    : steps_(std::move(steps)),
      motor_{{kMainPerCount, kMainTopSpeed},
             {kMainPerCount, kMainTopSpeed},
             {kZPerCount, kZTopSpeed}} {
  for (reference::ChainSide* side : {&judge_.left, &judge_.right}) {
    side->weight = 0.00137293;
    side->compliance = 5.2e-6;
  }
  motor_[kLeftAxis].travel = motor_[kRightAxis].travel = 1651;
}

int16_t Stage::read() {
  passGap();
  if (input_.empty() || byte_credit_ < 1) return -1;
  byte_credit_ -= 1;
  const char c = input_.front();
  input_.erase(0, 1);
  return uint8_t(c);
}

void Stage::write(char character) {
  passGap();
  while (out_queue_ >= kOutRoom) passMillisecond();
  ++out_queue_;
  if (character != '\n') {
    if (uint8_t(character) > 126 || (uint8_t(character) < 32 && character != '\r'))
      fail("a character that is no ASCII text");
    partial_ += character;
    return;
  }
  if (partial_.empty() || partial_.back() != '\r')
    fail("a line does not end in CR LF: " + partial_);
  partial_.pop_back();
  takeLine(partial_);
  partial_.clear();
}

void Stage::takeLine(const std::string& line) {
  last_line_ms_ = now_ms_;
  if (startsWith(line, "<"))
    latest_status_ = line, status_ms_ = now_ms_;
  else if (startsWith(line, "[PE:"))
    latest_errors_ = line;
  else
    lines_.push_back(line);
  if (line == "ok" || startsWith(line, "error:")) ++answers_;
  if (!startsWith(line, "ALARM: Halted")) return;
  ++halts_;
  // Its `ok` comes instead of the line's.
  if (stops_when_halted_) input_ += "!\n";
}

void Stage::drive(Axis axis, int16_t duty) {
  motor_[axis].duty = duty;
  motor_[axis].powered = true;
  motor_[axis].shorted = false;
}

void Stage::release(Axis axis) {
  motor_[axis].duty = 0;
  motor_[axis].powered = motor_[axis].shorted = false;
}

void Stage::brake(Axis axis) {
  release(axis);
  motor_[axis].shorted = true;
}

uint16_t Stage::count(Axis axis) { return motor_[axis].countMissing(); }

void Stage::arrange(bool, uint8_t) {}

void Stage::set(Output output, bool high) { pulse(output, high ? 255 : 0); }

void Stage::pulse(Output output, uint8_t level) {
  passGap();
  (output == Output::kSpindle ? spindle_ : laser_) = level;
}

void Stage::callTick() {
  if (chance_ == 0 || is_tick_due_) runTick();
  if (chance_ == 0) return;
  const uint32_t kMostGaps = 256;  // roughly as many as fit into a tick's time
  is_tick_due_ = true;
  chance_ = chance_ * 1664525 + 1013904223;
  gaps_to_pass_ = int(chance_ >> 16) % int(kMostGaps);
}

void Stage::runTick() {
  is_tick_due_ = false;
  is_ticking_ = true;
  tick();
  is_ticking_ = false;
}

void Stage::passGap() {
  if (!is_tick_due_ || is_ticking_ || holds_ != 0) return;
  if (gaps_to_pass_-- <= 0) runTick();
}

void Stage::passMillisecond() {
  ++now_ms_;
  out_queue_ = std::max(0, out_queue_ - int(now_ms_ % 8 == 0 ? 5 : 6));
  byte_credit_ = std::min(byte_credit_ + kBytesPerMs, 12.0);
  for (SimulatedMotor& motor : motor_) motor.advance(0.001);
  eeprom.advance(1000);
  if (now_ms_ % kTickMs == 0) callTick();
  look();
  if (now_ms_ - last_line_ms_ > kLongestGapMs) fail("silence for over 1.5 s");
}

void Stage::idle() {
  passMillisecond();
  while (at_ < steps_.size() && takeStep(steps_[at_])) {
    ++at_;
    step_since_ms_ = now_ms_;
  }
  if (at_ < steps_.size()) return;
  if (!lines_.empty()) fail("one line too many: " + lines_.front());
  throw TheEnd();
}

void Stage::restart() {
  for (SimulatedMotor& motor : motor_) motor.restartCount();
  holds_ = 0;
  is_tick_due_ = false;
  for (const Axis axis : {kLeftAxis, kRightAxis, kZAxis}) release(axis);
  spindle_ = laser_ = 0;
  input_.clear();
  partial_.clear();
  lines_.clear();
  out_queue_ = 0;
  last_line_ms_ = now_ms_ - kLongestGapMs + 500;  // the first line is due in half a second
}

bool Stage::takeStep(const Step& step) {
  switch (step.kind) {
    case Step::kSend:
      input_ += step.text + "\n";
      return true;
    case Step::kSendRaw:
      for (std::size_t i = 0; i < step.text.size(); ++i) {
        const bool special = step.text[i] == '^' && i + 1 < step.text.size();
        if (!special)
          input_ += step.text[i];
        else
          input_ += specialNamed(step.text[++i]);
      }
      return true;
    case Step::kExpect:
      return expect(step);
    case Step::kSkipTo:
      return skipTo(step);
    case Step::kAsk:
      return ask(step);
  }
  return false;
}

bool Stage::expect(const Step& step) {
  if (lines_.empty()) {
    if (now_ms_ - step_since_ms_ > kPatienceMs) fail("nothing came");
    return false;
  }
  const std::string line = lines_.front();
  lines_.pop_front();
  if (!matches(line, readExpected(step.text))) fail("came instead: " + line);
  return true;
}

bool Stage::skipTo(const Step& step) {
  while (!lines_.empty()) {
    const std::string line = lines_.front();
    lines_.pop_front();
    if (matches(line, readExpected(step.text))) return true;
  }
  if (now_ms_ - step_since_ms_ > kPatienceMs) fail("it did not come");
  return false;
}

std::string Stage::whereInTheScript() const {
  const std::size_t at = std::min(at_, steps_.size() - 1);
  return steps_[at].place + ": " + steps_[at].text;
}

void Stage::fail(const std::string& why) const {
  throw Failure(whereInTheScript() + "\n  " + why + "\n  at " + std::to_string(now_ms_) + " ms; " +
                latest_status_ + latest_errors_);
}
