// What a dialogue may ask of the simulated machine, and do to it.
#include <cmath>
#include <cstdio>
#include <sstream>

#include "reference/reference.h"
#include "stage.h"

using namespace machine;

namespace {

/// Numbers out of words such as `X100 Y-50 within 0.05 mm`, in order.
std::vector<double> numbersIn(const std::string& text) {
  std::vector<double> numbers;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = numberLength(text.c_str() + at);
    if (length != 0) numbers.push_back(std::atof(text.c_str() + at));
    at += length != 0 ? length : 1;
  }
  return numbers;
}

}  // namespace

bool Stage::ask(const Step& step) {
  std::istringstream words(step.text);
  std::string verb, rest;
  words >> verb;
  std::getline(words >> std::ws, rest);
  const auto is = [&](const char* other) { return verb == other; };
  if (is("wait")) return wait(rest);
  if (is("await")) {
    if (now_ms_ - step_since_ms_ > 2000000) fail("only " + std::to_string(answers_) + " came");
    return answers_ >= std::atoi(rest.c_str());
  }
  if (is("hold")) return askHold(numbersIn(rest).at(0));
  // On real pins a motor without power briefly looks like a motor at a duty of zero.
  const long kLooksAlikeMs = 200;
  if (is("off") && motorNamed(rest).powered && now_ms_ - step_since_ms_ < kLooksAlikeMs)
    return false;
  // Pulses are known by their edges, a few milliseconds late.
  const long kMeasuredMs = 20;
  if ((is("laser") || is("spindle")) && now_ms_ - step_since_ms_ < kMeasuredMs &&
      !isLevel(rest, is("laser") ? laser_ : spindle_))
    return false;
  // Of a report that was sent after the question.
  if ((is("status") || is("errors")) && status_ms_ <= step_since_ms_) return false;
  if (is("sled"))
    askSled(rest);
  else if (is("chains"))
    askChains(rest);
  else if (is("z")) {
    const std::vector<double> wanted = numbersIn(rest);
    const double z = motor_[kZAxis].travel;
    tellOr(std::fabs(z - wanted.at(0)) <= wanted.at(1), "z is at " + std::to_string(z));
  } else if (is("status"))
    tellOr(matches(latest_status_, readExpected(rest)), "it is");
  else if (is("errors"))
    tellOr(matches(latest_errors_, readExpected(rest)), "they are");
  else if (is("answers")) {
    // From here on, or this many since then; lines in between are passed over.
    lines_.clear();
    const int since = answers_;
    if (rest == "from now") answers_ = 0;
    tellOr(rest == "from now" || since == std::atoi(rest.c_str()), std::to_string(since) + " came");
  } else if (is("quiet"))
    tellOr(lines_.empty(), lines_.empty() ? "" : "came: " + lines_.front());
  else
    return change(verb, rest);
  return true;
}

bool Stage::wait(const std::string& seconds) {
  return double(now_ms_ - step_since_ms_) >= 1000 * std::atof(seconds.c_str());
}

bool Stage::change(const std::string& verb, const std::string& rest) {
  const auto is = [&](const char* other) { return verb == other; };
  if (is("hang"))
    hang(rest);
  else if (is("declare"))
    declare();
  else if (is("block") || is("free"))
    motorNamed(rest).stuck = is("block");
  else if (is("unplug") || is("plug"))
    motorNamed(rest).unplugged = is("unplug");
  else if (is("coast"))
    motorNamed(rest.substr(0, rest.find(' '))).coasting = numbersIn(rest).at(0);
  else if (is("miss"))
    motorNamed(rest.substr(0, rest.find(' '))).to_miss = int(numbersIn(rest).at(0));
  else if (is("complain"))
    motorNamed(rest).complains = true;
  else if (is("supply"))
    supply_ = numbersIn(rest).at(0);
  else if (is("reverse"))
    motorNamed(rest).reversed = true;
  else if (is("hook"))
    hook(motorNamed(rest.substr(0, rest.find(' '))), numbersIn(rest).at(0));
  else if (is("unhook"))
    motorNamed(rest).tight_at = -1e9;
  else if (is("pull"))
    motorNamed(rest.substr(0, rest.find(' '))).by_hand = numbersIn(rest).at(0);
  else if (is("off") || is("on"))
    tellOr(motorNamed(rest).powered == is("on"), "it is not");
  else if (is("spindle"))
    tellOr(isLevel(rest, spindle_), "it is at " + std::to_string(spindle_));
  else if (is("servo"))
    tellOr(servo == (rest == "loose" ? kNoServo : std::atoi(rest.c_str())),
           "it is at " + std::to_string(servo));
  else if (is("laser"))
    tellOr(isLevel(rest, laser_), "it is at " + std::to_string(laser_));
  else if (is("probe"))
    probe_touches_at_ = numbersIn(rest).at(0);
  else if (is("stop-when-halted"))
    stops_when_halted_ = true;
  else if (is("halts"))
    tellOr(halts_ >= std::atoi(rest.c_str()), std::to_string(halts_) + " came");
  else if (is("power")) {
    ++at_;
    step_since_ms_ = now_ms_;
    throw PowerGone();
  } else
    fail("nobody understands " + verb);
  return true;
}

bool Stage::askHold(double most) {
  const Eigen::Vector2d paid_out(motor_[kLeftAxis].travel, motor_[kRightAxis].travel);
  const reference::Settled settled =
      reference::settle(judge_, paid_out, Eigen::Vector2d(held_x_, held_y_));
  if (!settled.solved) fail("the judge finds no place for these chains");
  if (!is_holding_) {
    input_ += '\x84';
    held_x_ = settled.bit.x();
    held_y_ = settled.bit.y();
    is_holding_ = true;
    return false;
  }
  if (now_ms_ - step_since_ms_ < 1000) return false;
  is_holding_ = false;
  const double way = std::hypot(settled.bit.x() - held_x_, settled.bit.y() - held_y_);
  tellOr(way <= most, "it went on for " + std::to_string(way));
  return true;
}

bool Stage::isLevel(const std::string& wanted, int level) {
  const std::vector<double> numbers = numbersIn(wanted);
  const double is = wanted == "high" ? 255 : wanted == "low" ? 0 : numbers.at(0);
  const double within = numbers.size() > 1 ? numbers.at(1) : 0;
  return std::fabs(level - is) <= within;
}

void Stage::askSled(const std::string& place) {
  const std::vector<double> wanted = numbersIn(place);
  const Eigen::Vector2d at(wanted.at(0), wanted.at(1));
  const Eigen::Vector2d paid_out(motor_[kLeftAxis].travel, motor_[kRightAxis].travel);
  const reference::Settled settled = reference::settle(judge_, paid_out, at);
  if (!settled.solved) fail("the judge finds no place for these chains");
  const double off = (settled.bit - at).norm();
  std::ostringstream sentence;
  sentence << "the sled is at " << settled.bit.x() << " " << settled.bit.y() << ", off by " << off;
  tellOr(off <= wanted.at(2), sentence.str());
}

void Stage::askChains(const std::string& lengths) {
  const std::vector<double> wanted = numbersIn(lengths);
  const double left = motor_[kLeftAxis].travel, right = motor_[kRightAxis].travel;
  const bool near = std::fabs(left - wanted.at(0)) <= wanted.at(2) &&
                    std::fabs(right - wanted.at(1)) <= wanted.at(2);
  tellOr(near, "they are " + std::to_string(left) + " " + std::to_string(right));
}

void Stage::hang(const std::string& place) {
  const std::vector<double> at = numbersIn(place);
  const reference::Hang hung = reference::hangAt(judge_, {at.at(0), at.at(1)});
  if (!hung.solved) fail("no sled can hang there");
  motor_[kLeftAxis].travel = hung.paid_out.x();
  motor_[kRightAxis].travel = hung.paid_out.y();
}

void Stage::hook(SimulatedMotor& motor, double slack) {
  const double kBeyond = 12.7;  // [mm] of links past the other sprocket's 12 o'clock
  motor.tight_at = judge_.motor_gap + kBeyond;
  motor.travel = motor.tight_at + slack;
}

void Stage::declare() {
  char words[60];
  std::snprintf(words, sizeof words, "B06 L%.4f R%.4f\n", motor_[kLeftAxis].travel,
                motor_[kRightAxis].travel);
  input_ += words;
}

void Stage::tellOr(bool holds, const std::string& what) {
  if (!holds) fail(what);
}

SimulatedMotor& Stage::motorNamed(const std::string& name) {
  for (const Axis axis : {kLeftAxis, kRightAxis, kZAxis}) {
    const char* const names[] = {"left", "right", "z"};
    if (name == names[axis]) return motor_[axis];
  }
  fail("left, right or z");
}
