// The pulls of B11, one after the other.
#include "chain_pull.h"

namespace machine {
namespace {

const float kSlack = 5, kRetreat = 2;  // [mm] paid out before the first pull, and before others
const int16_t kRetreatDuty = 20;       // more than with which a slack chain is wound in
const float kWrongWay = 1;             // [mm] wound in by a motor that should pay out
const uint16_t kPayOutMs = 600;        // a motor with full power needs 300 ms for kSlack
const uint8_t kRestMs = 60;
const uint16_t kNextPullMs = 1400;  // another pull takes so long
const uint8_t kPassMs = 10;
const uint8_t kSpinUp = 40, kSteady = 30;                   // [passes]
const int16_t kFirstDuty = 70, kLastDuty = 180, kRamp = 2;  // with which a slack chain is wound in
const int16_t kMoreDuty = 28;                               // to be there sooner
const float kRunning = 4;                                   // [rpm] of a slack chain
const float kLeast = 1;       // [rpm] a motor that is slower with a slack chain is not well
const float kTouches = 0.3f;  // [rpm] lost by a fast motor where the chain begins to pull
const float kLost = 1.2f;     // [rpm] of a chain that is tight
const float kFalls = 0.2f;    // [rpm] the speed falls, noise aside
const float kStands = 0.3f;
const float kPerRpm = 38;  // [N] of chain that slow a motor down by a turn a minute
const float kPullOfSlack =
    34;  // [N] of the slack chain, and of what is wound in until the motor stands

}  // namespace

ChainPull::Result ChainPull::run(uint32_t ms) {
  const uint8_t kPulls = 3;
  start_ms_ = waiting_.milliseconds();
  most_ms_ = ms;
  Result result = payOut(kSlack, -255);
  if (result == Result::kTaut) result = findFreeSpeed();
  if (result == Result::kTaut) result = windInFast();
  // A fast chain may have become tight at once.
  if (result == Result::kTaut) result = isOver(kNextPullMs) ? windIn(false) : pullAgain();
  while (result == Result::kTaut && pulls_ < kPulls && !isOver(kNextPullMs)) result = pullAgain();
  return result;
}

float ChainPull::force() const { return kPullOfSlack + kPerRpm * (free_ - speed_); }

ChainPull::Result ChainPull::pullAgain() {
  const Result result = payOut(kRetreat, int16_t(-duty_ - kRetreatDuty));
  return result == Result::kTaut ? windIn(true) : result;
}

ChainPull::Result ChainPull::payOut(float mm, int16_t duty) {
  const uint32_t start = waiting_.milliseconds();
  const float from = axes_.length(axis_);
  float paid = 0;
  axes_.driveOpen(axis_, duty);
  waiting_.waitWhile([&] {
    paid = axes_.length(axis_) - from;
    return paid < mm && paid > -kWrongWay && waiting_.milliseconds() - start < kPayOutMs;
  });
  if (rest() == Result::kStopped) return Result::kStopped;
  return paid < mm ? Result::kDead : Result::kTaut;
}

ChainPull::Result ChainPull::findFreeSpeed() {
  duty_ = most_duty_ < kFirstDuty ? most_duty_ : kFirstDuty;
  const int16_t last = most_duty_ < kLastDuty ? most_duty_ : kLastDuty;
  speed_ = 0;
  for (; duty_ < last && speed_ < kRunning; duty_ = int16_t(duty_ + kRamp))
    if (!pass(duty_)) return Result::kStopped;
  for (uint8_t i = 0; i < kSteady; ++i)
    if (!pass(duty_)) return Result::kStopped;
  free_ = speed_;
  return free_ < kLeast ? Result::kDead : Result::kTaut;
}

ChainPull::Result ChainPull::windInFast() {
  const int16_t more = int16_t(duty_ + kMoreDuty);
  const int16_t duty = more < most_duty_ ? more : most_duty_;
  float fastest = 0;
  do {
    if (isOver(kRestMs)) return Result::kSlack;
    if (!pass(duty)) return Result::kStopped;
    if (speed_ > fastest) fastest = speed_;
  } while (speed_ > fastest - kTouches && speed_ > kStands);
  return rest();
}

ChainPull::Result ChainPull::rest() {
  axes_.driveOpen(axis_, 0);
  return waiting_.waitFor(kRestMs) ? Result::kTaut : Result::kStopped;
}

ChainPull::Result ChainPull::windIn(bool from_slack) {
  const float tight = free_ - kLost > kStands ? free_ - kLost : kStands;
  float fastest = 0;
  speed_ = 0;
  uint8_t passes = 0;
  bool is_tight = false;
  do {
    if (isOver(kRestMs)) return Result::kSlack;
    if (!pass(duty_)) return Result::kStopped;
    if (speed_ > fastest) fastest = speed_;
    if (passes < kSpinUp) ++passes;
    const bool falls = passes > kSpinUp / 2 && speed_ < fastest - kFalls;
    is_tight = speed_ <= tight && (falls || passes == kSpinUp);
  } while (!is_tight);
  if (rest() == Result::kStopped) return Result::kStopped;
  if (from_slack && fastest <= tight) return Result::kDead;
  note(axes_.length(axis_));
  return Result::kTaut;
}

bool ChainPull::pass(int16_t duty) {
  const float kShare = 0.25f;  // counts are coarse
  axes_.driveOpen(axis_, duty);
  const bool goes_on = waiting_.waitFor(kPassMs);
  speed_ += (-axes_.state(axis_).rpm - speed_) * kShare;
  return goes_on;
}

void ChainPull::note(float length) {
  if (pulls_ == 0 || length < shortest_) shortest_ = length;
  if (pulls_ == 0 || length > longest_) longest_ = length;
  sum_ += length;
  ++pulls_;
}

}  // namespace machine
