// The control tick, and the main program's view of it.
#include "axes.h"

#include <math.h>

#include "settings_table.h"

namespace machine {
namespace {

const float kCountsMissed = 2;  // [encoder counts] an illegal step is two edges at once
const float kShareOfLimit = 8;  // missed steps may take an eighth of the position error's limit
// [1/256] Below this share of the planned speed the operator hears of it.
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
    Controlled& controlled = axis_[i];
    const bool z = i == kZAxis;
    const float counts = values.at(z ? kZCounts : kEncoderCounts);
    const float length = withinTravel(float(controlled.counts) * controlled.per_count);
    const float was_per_count = controlled.per_count;
    controlled.per_count = values.at(z ? kZPerTurn : kChainPerTurn) / counts;
    controlled.turns_per_count = 1 / float(fabs(counts));
    controlled.turns_per_mm = controlled.turns_per_count / controlled.per_count;
    controlled.turns_per_fine = controlled.turns_per_mm / float(motion::kCountsPerMm);
    controlled.fine_per_count = controlled.per_count * float(motion::kCountsPerMm);
    const float most = kMostTravel / float(fabs(controlled.per_count));
    controlled.most_counts = most < 2e9f ? int32_t(most) : 2000000000;
    const float most_missed = values.at(kPositionErrorLimit) / kShareOfLimit /
                              (kCountsMissed * float(fabs(controlled.per_count)));
    controlled.most_missed =
        most_missed < UINT16_MAX ? uint16_t(most_missed) : uint16_t(UINT16_MAX);
    if (controlled.per_count != was_per_count) {
      controlled.counts = countsOf(controlled, length);
      is_rescaled = true;
    }
    // A negative number of counts means that motor or encoder is wired the other way.
    controlled.sign = counts < 0 ? -1 : 1;
    controlled.loop.tune(gainsFrom(values, z ? kZPositionP : kMainPositionP),
                         gainsFrom(values, z ? kZSpeedP : kMainSpeedP), float(fabs(counts)),
                         seconds_per_tick_);
    controlled.watch.tune(values.at(kPositionErrorLimit), float(fabs(counts)), seconds_per_tick_);
    controlled.is_held = values.at(z ? kZPositionP : kMainPositionP) > 0;
  }
  yield_.tune(values.at(kPositionErrorLimit));
  return is_rescaled;
}

int32_t Axes::countsOf(const Controlled& controlled, float length) {
  const float counts = length / controlled.per_count;
  if (counts >= float(controlled.most_counts)) return controlled.most_counts;
  return counts <= -float(controlled.most_counts) ? -controlled.most_counts
                                                  : int32_t(lround(counts));
}

void Axes::simulate(bool on) {
  const WithoutTicks hold(clock_);
  if (on && !simulated_) {
    is_imagined_ = false;
    for (Controlled& controlled : axis_) controlled.astray = 0;
  }
  simulated_ = on;
}

void Axes::imagine(Controlled& controlled, int32_t counts) {
  if (controlled.counts != counts) is_imagined_ = true;
  controlled.counts = counts;
}

void Axes::readEncoder(Controlled& controlled, Axis axis) {
  const uint16_t raw = drives_.count(axis);
  const int16_t moved = int16_t(raw - controlled.raw);
  controlled.raw = raw;
  controlled.moved = moved;
  if (!simulated_) {
    controlled.counts += moved;
    return;
  }
  const int16_t kAstray = 12;  // [encoder counts] 0.1 mm of chain
  controlled.astray = int16_t(controlled.astray + moved);
  if (controlled.astray > kAstray || controlled.astray < -kAstray) is_imagined_ = true;
}

void Axes::takeSetPoint() {
  Controlled &left = axis_[kLeftAxis], &right = axis_[kRightAxis], &z = axis_[kZAxis];
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

void Axes::control(Controlled& controlled, Axis axis) {
  const float turned = float(controlled.moved) * controlled.turns_per_count;
  controlled.loop.measure(turned);
  if (controlled.mode == AxisMode::kOff) return;
  if (controlled.mode == AxisMode::kFollow) {
    if (simulated_) {
      imagine(controlled,
              int32_t(lround(motion::toMm<float>(controlled.set_point) / controlled.per_count)));
      return;
    }
    const int32_t ahead = controlled.set_point - measured(controlled);
    const int32_t size = ahead < 0 ? -ahead : ahead;
    if (size > controlled.most_behind) controlled.most_behind = size;
    if (size > worst_off_ && controlled.is_held) worst_off_ = size;
    const float error = motion::toMm<float>(ahead);
    const float asked =
        controlled.asked == 0 ? 0 : float(controlled.asked) * controlled.turns_per_fine;
    controlled.duty = controlled.loop.follow(error * controlled.turns_per_mm, asked, turned);
    const motion::Fault seen = controlled.watch.look(controlled.duty, controlled.moved, error);
    if (seen != motion::Fault::kNone && controlled.is_held) note(seen, axis);
  } else if (controlled.mode == AxisMode::kTurn) {
    controlled.duty = controlled.loop.run(controlled.rpm);
  }
  // A positive drive winds chain in; a positive duty here pays it out.
  const int16_t drive =
      controlled.mode == AxisMode::kOpen ? controlled.duty : int16_t(-controlled.duty);
  if (!simulated_) drives_.drive(axis, controlled.sign < 0 ? int16_t(-drive) : drive);
}

void Axes::watchForSlips() {
  bool is_even = !simulated_;
  for (uint8_t i = 0; i < kAxisCount; ++i)
    is_even = paces_[i].isKept(axis_[i].asked) && is_even && axis_[i].mode == AxisMode::kFollow;
  for (uint8_t i = 0; i < kZAxis; ++i) slip_watches_[i].measure(axis_[i].duty);
  for (uint8_t i = 0; i < kZAxis; ++i) {
    const bool is_alone = is_even && !slip_watches_[1 - i].isRestless();
    if (slip_watches_[i].look(is_alone && motion::Pace::moves(axis_[i].asked)))
      slips_[i] = uint8_t(slips_[i] + 1);
  }
}

void Axes::note(motion::Fault seen, Axis axis) {
  if (seen != motion::Fault::kLeftBehind) disproved_ = uint8_t(disproved_ | (1 << axis));
  if (seen > fault_) fault_ = seen;
}

int32_t Axes::measured(const Controlled& controlled) const {
  // Counts that were stored under other settings may mean any length.
  int32_t counts = controlled.counts;
  if (counts > controlled.most_counts) counts = controlled.most_counts;
  if (counts < -controlled.most_counts) counts = -controlled.most_counts;
  return int32_t(lround(float(counts) * controlled.fine_per_count));
}

void Axes::tick() {
  takeSetPoint();
  worst_off_ = 0;
  for (uint8_t i = 0; i < kAxisCount; ++i) {
    readEncoder(axis_[i], Axis(i));
    control(axis_[i], Axis(i));
  }
  watchForSlips();
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

void Axes::stand() {
  const WithoutTicks hold(clock_);
  playback_.hold();
  lift_.brake();
}

void Axes::goOn() {
  const WithoutTicks hold(clock_);
  playback_.resume();
}

bool Axes::isPathAtRest() const {
  const WithoutTicks hold(clock_);
  return playback_.isAtRest();
}

bool Axes::isAtRest() const {
  const WithoutTicks hold(clock_);
  return playback_.isAtRest() && lift_.isAtRest();
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

void Axes::lower(float speed, float acceleration) {
  const WithoutTicks hold(clock_);
  lift_.goTo(0, motion::toCounts(speed * seconds_per_tick_),
             motion::toCounts(acceleration * seconds_per_tick_ * seconds_per_tick_));
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
  Controlled& controlled = axis_[kZAxis];
  const int32_t planned = controlled.set_point - lift_.at();
  controlled.counts = int32_t(lround(withinTravel(z) / controlled.per_count));
  controlled.set_point = motion::toCounts(withinTravel(z));
  lift_.standAt(controlled.set_point - planned);
  forgetMissed(kZAxis);
}

SetPoint Axes::setPoint() const {
  const WithoutTicks hold(clock_);
  return {axis_[kLeftAxis].set_point, axis_[kRightAxis].set_point, axis_[kZAxis].set_point};
}

void Axes::standStill() {
  const WithoutTicks hold(clock_);
  forgetWay();
  for (Controlled& controlled : axis_) controlled.set_point = measured(controlled);
}

void Axes::jumpTo(Axis axis, float length) {
  const WithoutTicks hold(clock_);
  forgetWay();
  axis_[axis].set_point = motion::toCounts(withinTravel(length));
}

int32_t Axes::counts(Axis axis) const {
  const WithoutTicks hold(clock_);
  return axis_[axis].counts;
}

void Axes::setCounts(int32_t left, int32_t right, int32_t z) {
  const int32_t counts[kAxisCount] = {left, right, z};
  const WithoutTicks hold(clock_);
  releaseAll();
  for (uint8_t i = 0; i < kAxisCount; ++i) axis_[i].counts = counts[i];
  standStill();
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
  Controlled& controlled = axis_[axis];
  length = withinTravel(length);
  if (simulated_) is_imagined_ = true;
  controlled.counts = countsOf(controlled, length);
  controlled.set_point = motion::toCounts(length);
  forgetMissed(axis);
}

AxisState Axes::state(Axis axis) const {
  const WithoutTicks hold(clock_);
  const Controlled& controlled = axis_[axis];
  return {controlled.loop.rpm(), controlled.loop.wanted(), controlled.duty};
}

void Axes::forgetRawCounts() {
  const WithoutTicks hold(clock_);
  for (uint8_t i = 0; i < kAxisCount; ++i) {
    axis_[i].raw = drives_.count(Axis(i));
    forgetMissed(Axis(i));
  }
}

bool Axes::hasMissedSteps(Axis axis) const {
  const Controlled& controlled = axis_[axis];
  const uint16_t missed = uint16_t(drives_.illegalSteps(axis) - controlled.missed_before);
  return missed > controlled.most_missed && !simulated_;
}

motion::Fault Axes::fault() {
  const WithoutTicks hold(clock_);
  const motion::Fault was = fault_;
  fault_ = motion::Fault::kNone;
  return was;
}

}  // namespace machine
