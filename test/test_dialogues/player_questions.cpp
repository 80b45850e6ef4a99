// The questions and actions of a dialogue, for either build of the firmware.
#include <cmath>
#include <cstdio>
#include <sstream>

#include "line_match.h"
#include "player.h"
#include "reference/reference.h"

using world::Axis;

namespace {

const char* const kAxes[] = {"left", "right", "z"};
// Drivers show a duty of zero and no power alike. A motor that follows its set-points is not at
// zero for so long.
const long kUnpoweredMs = 150;
const double kLooksAlike = 0.25;  // [s] in which a motor may still be let go
const double kMeasured = 0.02;    // [s] in which a pulse's length becomes known
// A question that ends like this does not wait.
const char kAtOnce[] = " at once";
const int kDriven = 25;       // of 255: a duty that turns a motor
const double kBeyond = 12.7;  // [mm] of links past the other sprocket's 12 o'clock

bool isAtOnce(const Words& words) { return words.all.find(kAtOnce) != std::string::npos; }

}  // namespace

Words::Words(std::string text) : all(std::move(text)), first(all.substr(0, all.find(' '))) {
  for (std::size_t at = 0; at < all.size();) {
    const std::size_t length = numberLength(all.c_str() + at);
    if (length != 0) numbers.push_back(std::atof(all.c_str() + at));
    at += length != 0 ? length : 1;
  }
}

double Words::number(std::size_t place) const {
  if (place >= numbers.size()) throw Failure("a number is missing behind the question: " + all);
  return numbers[place];
}

const std::map<std::string, Player::Question>& Player::questions() {
  static const std::map<std::string, Question> kQuestions = {
      {"wait", &Player::wait},
      {"await", &Player::await},
      {"answers", &Player::askAnswers},
      {"quiet", &Player::askQuiet},
      {"status", &Player::askStatus},
      {"errors", &Player::askErrors},
      {"sled", &Player::askSled},
      {"chains", &Player::askChains},
      {"z", &Player::askHeight},
      {"hold", &Player::askHold},
      {"off", &Player::askOff},
      {"on", &Player::askOn},
      {"undriven", &Player::askUndriven},
      {"wound", &Player::askWound},
      {"paid", &Player::askPaid},
      {"spindle", &Player::askSpindle},
      {"laser", &Player::askLaser},
      {"servo", &Player::askServo},
      {"halts", &Player::askHalts},
      {"declare", &Player::declare},
      {"stop-when-halted", &Player::stopWhenHalted},
      {"power", &Player::cutPower},
      {"shield", &Player::setShield},
  };
  return kQuestions;
}

bool Player::ask(const Step& step) {
  const std::size_t space = step.text.find(' ');
  if (!question_) question_.emplace(space == std::string::npos ? "" : step.text.substr(space + 1));
  const std::string verb = step.text.substr(0, space);
  const Words& words = *question_;
  const auto question = questions().find(verb);
  if (question != questions().end()) return (this->*question->second)(words);
  return disturb(verb, words) || askBoard(verb, words);
}

bool Player::askBoard(const std::string& verb, const Words&) { fail("nobody understands " + verb); }

bool Player::wait(const Words& words) { return hasWaited(words.number()); }

bool Player::await(const Words& words) {
  const double kLongest = 2000;  // [s]
  tellOr(!hasWaited(kLongest), "only " + std::to_string(answers_) + " came");
  return answers_ >= int(words.number());
}

bool Player::askAnswers(const Words& words) {
  // From here on, or this many since then; lines in between are passed over.
  lines_.clear();
  const int since = answers_;
  const bool begins = words.all == "from now";
  if (begins) answers_ = 0;
  tellOr(begins || since == int(words.number()), std::to_string(since) + " came");
  return true;
}

bool Player::askQuiet(const Words&) {
  if (!lines_.empty()) fail("came: " + lines_.front());
  return true;
}

bool Player::askStatus(const Words& words) {
  // Of a report that was sent after the question.
  if (status_ms_ <= step_since_ms_) return false;
  tellOr(matches(status_, readExpected(words.all)), "it is");
  return true;
}

bool Player::askErrors(const Words& words) {
  if (status_ms_ <= step_since_ms_ || errors_.empty()) return false;
  tellOr(matches(errors_, readExpected(words.all)), "they are");
  return true;
}

Eigen::Vector2d Player::placeNear(const Eigen::Vector2d& place) const {
  const Eigen::Vector2d paid_out(world_.travel(world::kLeft), world_.travel(world::kRight));
  const reference::Hang settled = reference::settle(world_.sled().machine(), paid_out, place);
  tellOr(settled.solved, "the judge finds no place for these chains");
  return settled.bit;
}

bool Player::askSled(const Words& words) {
  const Eigen::Vector2d wanted(words.number(0), words.number(1)), place = placeNear(wanted);
  const double off = (place - wanted).norm();
  std::ostringstream sentence;
  sentence << "the sled is at " << place.x() << " " << place.y() << ", off by " << off;
  tellOr(off <= words.number(2), sentence.str());
  return true;
}

bool Player::askChains(const Words& words) {
  const double left = world_.travel(world::kLeft), right = world_.travel(world::kRight);
  const bool near = std::fabs(left - words.number(0)) <= words.number(2) &&
                    std::fabs(right - words.number(1)) <= words.number(2);
  tellOr(near, "they are " + std::to_string(left) + " " + std::to_string(right));
  return true;
}

bool Player::askHeight(const Words& words) {
  const double z = world_.travel(world::kZ);
  tellOr(std::fabs(z - words.number(0)) <= words.number(1), "z is at " + std::to_string(z));
  return true;
}

bool Player::askHold(const Words& words) {
  const Eigen::Vector2d place = placeNear(held_at_.value_or(world_.sled().place()));
  if (!held_at_) {
    brain_.send("\x84");
    held_at_ = place;
  }
  if (!hasWaited(1)) return false;
  const double way = (place - *held_at_).norm();
  held_at_.reset();
  tellOr(way <= words.number(), "it went on for " + std::to_string(way));
  return true;
}

bool Player::askOff(const Words& words) {
  const Axis axis = axisOf(words);
  const bool is_on =
      isAtOnce(words) ? world_.duty(axis) != 0 : now_ms_ - driven_ms_[axis] < kUnpoweredMs;
  if (is_on && !isAtOnce(words) && !hasWaited(kLooksAlike)) return false;
  tellOr(!is_on, "it is not");
  return true;
}

bool Player::askOn(const Words& words) {
  tellOr(now_ms_ - driven_ms_[axisOf(words)] < (isAtOnce(words) ? 1 : kUnpoweredMs), "it is not");
  return true;
}

bool Player::askUndriven(const Words& words) {
  for (int axis = 0; axis < world::kAxisCount; ++axis) {
    tellOr(words.all == "from now" || (most_duty_[axis] == 0 && least_duty_[axis] == 0),
           std::string(kAxes[axis]) + " was driven");
    most_duty_[axis] = least_duty_[axis] = 0;
  }
  return true;
}

bool Player::askWound(const Words& words) {
  tellOr(most_duty_[axisOf(words)] > kDriven, "it did not");
  return true;
}

bool Player::askPaid(const Words& words) {
  tellOr(least_duty_[axisOf(words)] < -kDriven, "it did not");
  return true;
}

bool Player::askSpindle(const Words& words) { return askLevel(brain_.spindle(), words); }

bool Player::askLaser(const Words& words) { return askLevel(brain_.laser(), words); }

bool Player::askLevel(int level, const Words& words) {
  const double wanted = words.first == "high" ? 255 : words.first == "low" ? 0 : words.number();
  const double within = words.numbers.size() > 1 ? words.number(1) : 0;
  const bool is_so = std::fabs(level - wanted) <= within;
  if (!is_so && !isAtOnce(words) && !hasWaited(kMeasured)) return false;
  tellOr(is_so, "it is at " + std::to_string(level));
  return true;
}

bool Player::askServo(const Words& words) {
  const int kLoose = 255, degrees = brain_.servo();
  tellOr(degrees == (words.all == "loose" ? kLoose : int(words.number())),
         "it is at " + std::to_string(degrees));
  return true;
}

bool Player::askHalts(const Words& words) {
  tellOr(halts_ >= int(words.number()), std::to_string(halts_) + " came");
  return true;
}

bool Player::declare(const Words&) {
  char line[60];
  std::snprintf(line, sizeof line, "B06 L%.4f R%.4f\n", world_.travel(world::kLeft),
                world_.travel(world::kRight));
  brain_.send(line);
  return true;
}

bool Player::stopWhenHalted(const Words&) { return stops_when_halted_ = true; }

bool Player::cutPower(const Words&) { return is_power_cut_ = true; }

bool Player::setShield(const Words& words) {
  brain_.setShield(int(words.number()));
  return is_power_cut_ = true;
}

bool Player::disturb(const std::string& verb, const Words& words) {
  const auto is = [&](const char* other) { return verb == other; };
  if (is("hang"))
    world_.hangAt({words.number(0), words.number(1)});
  else if (is("weigh"))
    world_.set("sled_weight", words.number());
  else if (is("block") || is("free"))
    world_.wires(axisOf(words)).blocked = is("block");
  else if (is("unplug") || is("plug"))
    world_.wires(axisOf(words)).encoder_unplugged = is("unplug");
  else if (is("reverse"))
    world_.wires(axisOf(words)).motor_reversed = true;
  else if (is("complain"))
    world_.wires(axisOf(words)).driver_complains = true;
  else if (is("miss"))
    brain_.missEdges(axisOf(words), int(words.number()));
  else if (is("pull"))
    world_.pull(axisOf(words), words.number());
  else if (is("hook"))
    world_.hookAcross(axisOf(words), words.number(), kBeyond);
  else if (is("unhook"))
    world_.unhook();
  else if (is("supply"))
    brain_.setSupply(words.number());
  else if (is("probe"))
    world_.setProbeHeight(words.number());
  else
    return false;
  return true;
}

Axis Player::axisOf(const Words& words) const {
  for (int axis = 0; axis < world::kAxisCount; ++axis)
    if (words.first == kAxes[axis]) return Axis(axis);
  fail("left, right or z");
}
