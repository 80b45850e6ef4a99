// The control tick, and the main program's view of it.
#include "axes.h"

#include <math.h>

#include "settings_table.h"

namespace machine {
namespace {

// An illegal step is two edges at once.
const float kCountsMissed = 2;
const float kShareOfLimit = 8;  // that missed steps may take
// A share of the planned speed so low that it is to be told.
const uint16_t kMuch = 200;

float withinTravel(float length) {
  if (length > kMostTravel) return kMostTravel;
  return length < -kMostTravel ? -kMostTravel : length;
}

Gains gainsFrom(const settings::Values& values, uint8_t first) {
  return {values.at(first), values.at(uint8_t(first + 1)), values.at(uint8_t(first + 2)),
          values.at(uint8_t(first + 3))};
}

}  // namespace

bool Axes::prepare(const settings::Values& values) {
  const WithoutTicks hold(clock_);
  bool is_rescaled = false;
  for (uint8_t i = 0; i < kAxisCount; ++i) {
    One& one = axis_[i];
    const bool z = i == kZAxis;
    const float counts = values.at(z ? kZCounts : kEncoderCounts);
    const float length = withinTravel(float(one.counts) * one.per_count);
    const float was_per_count = one.per_count;
    one.per_count = values.at(z ? kZPerTurn : kChainPerTurn) / counts;
    one.turns_per_count = 1 / float(fabs(counts));
    one.turns_per_mm = one.turns_per_count / one.per_count;
    one.turns_per_fine = one.turns_per_mm / float(motion::kCountsPerMm);
    one.fine_per_count = one.per_count * float(motion::kCountsPerMm);
    const float most = kMostTravel / float(fabs(one.per_count));
    one.most_counts = most < 2e9f ? int32_t(most) : 2000000000;
    const float most_missed = values.at(kPositionErrorLimit) / kShareOfLimit /
                              (kCountsMissed * float(fabs(one.per_count)));
    one.most_missed = most_missed < UINT16_MAX ? uint16_t(most_missed) : uint16_t(UINT16_MAX);
    if (one.per_count != was_per_count) {
      one.counts = countsOf(one, length);
      is_rescaled = true;
    }
    // A negative number of counts says that motor or encoder is wired the other way.
    one.sign = counts < 0 ? -1 : 1;
    one.loop.tune(gainsFrom(values, z ? kZPositionP : kMainPositionP),
                  gainsFrom(values, z ? kZSpeedP : kMainSpeedP), float(fabs(counts)),
                  seconds_per_tick_);
    one.watch.tune(values.at(kPositionErrorLimit), float(fabs(counts)), seconds_per_tick_);
    one.is_held = values.at(z ? kZPositionP : kMainPositionP) > 0;
  }
  yield_.tune(values.at(kPositionErrorLimit));
  return is_rescaled;
}

int32_t Axes::countsOf(const One& one, float length) {
  const float counts = length / one.per_count;
  if (counts >= float(one.most_counts)) return one.most_counts;
  return counts <= -float(one.most_counts) ? -one.most_counts : int32_t(lround(counts));
}

void Axes::simulate(bool on) {
  const WithoutTicks hold(clock_);
  if (on && !simulated_) {
    is_imagined_ = false;
    for (One& one : axis_) one.astray = 0;
  }
  simulated_ = on;
}

void Axes::imagine(One& one, int32_t counts) {
  if (one.counts != counts) is_imagined_ = true;
  one.counts = counts;
}

void Axes::readEncoder(One& one, Axis axis) {
  const uint16_t raw = drives_.count(axis);
  const int16_t moved = int16_t(raw - one.raw);
  one.raw = raw;
  one.moved = moved;
  if (!simulated_) {
    one.counts += moved;
    return;
  }
  const int16_t kAstray = 12;  // [encoder counts] 0.1 mm of chain
  one.astray = int16_t(one.astray + moved);
  if (one.astray > kAstray || one.astray < -kAstray) is_imagined_ = true;
}

void Axes::takeSetPoint() {
  One &left = axis_[kLeftAxis], &right = axis_[kRightAxis], &z = axis_[kZAxis];
  SetPoint point = {left.set_point, right.set_point, z.set_point - lift_.at()};
  playback_.next(set_points_, point);
  lift_.advance();
  left.set_point = point.left;
  right.set_point = point.right;
  z.set_point = point.z + lift_.at();
  const SetPoint ahead = playback_.stepAhead(set_points_, ticks_ahead_);
  left.asked = ahead.left;
  right.asked = ahead.right;
  z.asked = ahead.z + lift_.speed();
}

void Axes::control(One& one, Axis axis) {
  const float turned = float(one.moved) * one.turns_per_count;
  one.loop.measure(turned);
  if (one.mode == AxisMode::kOff) return;
  if (one.mode == AxisMode::kFollow) {
    if (simulated_) {
      imagine(one, int32_t(lround(motion::toMm<float>(one.set_point) / one.per_count)));
      return;
    }
    const int32_t ahead = one.set_point - measured(one);
    const int32_t size = ahead < 0 ? -ahead : ahead;
    if (size > one.most_behind) one.most_behind = size;
    if (size > worst_off_ && one.is_held) worst_off_ = size;
    const float error = motion::toMm<float>(ahead);
    const float asked = one.asked == 0 ? 0 : float(one.asked) * one.turns_per_fine;
    one.duty = one.loop.follow(error * one.turns_per_mm, asked, turned);
    const motion::Fault seen = one.watch.look(one.duty, one.moved, error);
    if (seen != motion::Fault::kNone && one.is_held) note(seen, axis);
  } else if (one.mode == AxisMode::kTurn) {
    one.duty = one.loop.run(one.rpm);
  }
  // Positive drive winds in; a positive duty here lengthens.
  const int16_t drive = one.mode == AxisMode::kOpen ? one.duty : int16_t(-one.duty);
  if (!simulated_) drives_.drive(axis, one.sign < 0 ? int16_t(-drive) : drive);
}

void Axes::note(motion::Fault seen, Axis axis) {
  if (seen != motion::Fault::kLeftBehind) disproved_ = uint8_t(disproved_ | (1 << axis));
  if (seen > fault_) fault_ = seen;
}

int32_t Axes::measured(const One& one) const {
  // Counts kept under other settings may tell any length.
  int32_t counts = one.counts;
  if (counts > one.most_counts) counts = one.most_counts;
  if (counts < -one.most_counts) counts = -one.most_counts;
  return int32_t(lround(float(counts) * one.fine_per_count));
}

void Axes::tick() {
  takeSetPoint();
  worst_off_ = 0;
  for (uint8_t i = 0; i < kAxisCount; ++i) {
    readEncoder(axis_[i], Axis(i));
    control(axis_[i], Axis(i));
  }
  const uint16_t share = yield_.shareAt(worst_off_);
  playback_.yieldTo(share);
  if (share < kMuch) has_yielded_ = true;
}

bool Axes::hasYielded() {
  const bool has = has_yielded_;
  has_yielded_ = false;
  return has;
}

void Axes::dropSetPoints() {
  const WithoutTicks hold(clock_);
  forgetWay();
}

void Axes::forgetWay() {
  set_points_.clear();
  playback_.reset();
  lift_.absorb();
}

void Axes::hold(bool yes) {
  const WithoutTicks hold(clock_);
  if (yes)
    playback_.hold();
  else
    playback_.resume();
}

bool Axes::isAtRest() const {
  const WithoutTicks hold(clock_);
  return playback_.isAtRest();
}

bool Axes::isEmpty() const {
  const WithoutTicks hold(clock_);
  return set_points_.isEmpty() && playback_.isDone() && lift_.isAtRest();
}

void Axes::goAt(uint16_t share) {
  const WithoutTicks hold(clock_);
  playback_.goAt(share);
}

void Axes::lift(float z, float speed, float acceleration) {
  const WithoutTicks hold(clock_);
  const int32_t planned = axis_[kZAxis].set_point - lift_.at();
  lift_.goTo(motion::toCounts(withinTravel(z)) - planned,
             motion::toCounts(speed * seconds_per_tick_),
             motion::toCounts(acceleration * seconds_per_tick_ * seconds_per_tick_));
}

void Axes::lower() {
  const WithoutTicks hold(clock_);
  lift_.goBack();
}

float Axes::plannedZ() const {
  const WithoutTicks hold(clock_);
  return motion::toMm<float>(axis_[kZAxis].set_point - lift_.at());
}

float Axes::liftedTo() const {
  const WithoutTicks hold(clock_);
  return motion::toMm<float>(axis_[kZAxis].set_point - lift_.at() + lift_.goal());
}

bool Axes::isLifted() const {
  const WithoutTicks hold(clock_);
  return lift_.at() != 0 || lift_.goal() != 0;
}

void Axes::declareLifted(float z) {
  const WithoutTicks hold(clock_);
  One& one = axis_[kZAxis];
  const int32_t planned = one.set_point - lift_.at();
  one.counts = int32_t(lround(withinTravel(z) / one.per_count));
  one.set_point = motion::toCounts(withinTravel(z));
  lift_.standAt(one.set_point - planned);
  forgetMissed(kZAxis);
}

SetPoint Axes::setPoint() const {
  const WithoutTicks hold(clock_);
  return {axis_[kLeftAxis].set_point, axis_[kRightAxis].set_point, axis_[kZAxis].set_point};
}

void Axes::standStill() {
  const WithoutTicks hold(clock_);
  forgetWay();
  for (One& one : axis_) one.set_point = measured(one);
}

void Axes::jumpTo(Axis axis, float length) {
  const WithoutTicks hold(clock_);
  forgetWay();
  axis_[axis].set_point = motion::toCounts(withinTravel(length));
}

void Axes::follow() {
  const WithoutTicks hold(clock_);
  for (One& one : axis_) {
    if (one.mode == AxisMode::kFollow) continue;
    one.loop.rest();
    one.watch.rest();
    one.mode = AxisMode::kFollow;
  }
  fault_ = motion::Fault::kNone;
  disproved_ = 0;
}

void Axes::release(Axis axis) {
  const WithoutTicks hold(clock_);
  axis_[axis].mode = AxisMode::kOff;
  axis_[axis].duty = 0;
  drives_.release(axis);
}

void Axes::releaseAll() {
  for (uint8_t i = 0; i < kAxisCount; ++i) release(Axis(i));
}

void Axes::driveOpen(Axis axis, int16_t duty) {
  const WithoutTicks hold(clock_);
  axis_[axis].mode = AxisMode::kOpen;
  axis_[axis].duty = duty > 255 ? 255 : duty < -255 ? -255 : duty;
}

void Axes::turn(Axis axis, float rpm) {
  const WithoutTicks hold(clock_);
  One& one = axis_[axis];
  if (one.mode != AxisMode::kTurn) one.loop.rest();
  one.mode = AxisMode::kTurn;
  one.rpm = rpm;
}

bool Axes::isPowered() const {
  for (const One& one : axis_)
    if (one.mode != AxisMode::kOff) return true;
  return false;
}

bool Axes::isDriven() const {
  for (const One& one : axis_)
    if (one.mode == AxisMode::kOpen || one.mode == AxisMode::kTurn) return true;
  return false;
}

int32_t Axes::counts(Axis axis) const {
  const WithoutTicks hold(clock_);
  return axis_[axis].counts;
}

void Axes::setCounts(int32_t left, int32_t right, int32_t z) {
  const int32_t counts[kAxisCount] = {left, right, z};
  const WithoutTicks hold(clock_);
  for (uint8_t i = 0; i < kAxisCount; ++i) axis_[i].counts = counts[i];
}

float Axes::length(Axis axis) const { return float(counts(axis)) * axis_[axis].per_count; }

float Axes::target(Axis axis) const {
  const WithoutTicks hold(clock_);
  return motion::toMm<float>(axis_[axis].set_point);
}

float Axes::error(Axis axis) const {
  const WithoutTicks hold(clock_);
  return motion::toMm<float>(measured(axis_[axis]) - axis_[axis].set_point);
}

float Axes::mostBehind(Axis axis) {
  const WithoutTicks hold(clock_);
  const int32_t most = axis_[axis].most_behind;
  axis_[axis].most_behind = 0;
  return motion::toMm<float>(most);
}

void Axes::declare(Axis axis, float length) {
  const WithoutTicks hold(clock_);
  lift_.absorb();
  One& one = axis_[axis];
  length = withinTravel(length);
  if (simulated_) is_imagined_ = true;
  one.counts = countsOf(one, length);
  one.set_point = motion::toCounts(length);
  forgetMissed(axis);
}

AxisState Axes::state(Axis axis) const {
  const WithoutTicks hold(clock_);
  const One& one = axis_[axis];
  return {one.loop.rpm(), one.loop.wanted(), one.duty};
}

void Axes::forgetRawCounts() {
  const WithoutTicks hold(clock_);
  for (uint8_t i = 0; i < kAxisCount; ++i) {
    axis_[i].raw = drives_.count(Axis(i));
    forgetMissed(Axis(i));
  }
}

bool Axes::hasMissedSteps(Axis axis) const {
  const One& one = axis_[axis];
  const uint16_t missed = uint16_t(drives_.illegalSteps(axis) - one.missed_before);
  return missed > one.most_missed && !simulated_;
}

motion::Fault Axes::fault() {
  const WithoutTicks hold(clock_);
  const motion::Fault was = fault_;
  fault_ = motion::Fault::kNone;
  return was;
}

}  // namespace machine
