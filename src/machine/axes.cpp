// The tick of all axes: set-point, axes, slip watch, yielding feed. Then how the main program holds
// the way and lifts z off it.
#include "axes.h"

#include "settings_table.h"

namespace machine {
namespace {

// [1/256] The operator is notified below this share of the planned speed.
const uint16_t kMuch = 200;

}  // namespace

void Axes::tick() {
  takeSetPoint();
  int32_t worst_off = 0;
  for (TickedAxis& axis : axis_) {
    const int32_t off = axis.tick();
    if (off > worst_off) worst_off = off;
  }
  watchForSlips();
  const uint16_t share = yield_.shareAt(worst_off);
  playback_.yieldTo(share);
  if (share < kMuch) has_yielded_ = true;
}

void Axes::takeSetPoint() {
  TickedAxis &left = axis_[kLeftAxis], &right = axis_[kRightAxis], &z = axis_[kZAxis];
  SetPoint point = {left.setPoint(), right.setPoint(), plannedHeight()};
  playback_.next(set_points_, point);
  lift_.advance();
  left.setSetPoint(point.left);
  right.setSetPoint(point.right);
  z.setSetPoint(point.z + lift_.at());
  const SetPoint ahead = playback_.stepAhead(set_points_, ticks_ahead_);
  left.ask(ahead.left);
  right.ask(ahead.right);
  z.ask(ahead.z + lift_.speed());
}

void Axes::watchForSlips() {
  bool is_even = !isSimulated();
  for (uint8_t i = 0; i < kAxisCount; ++i) {
    const TickedAxis& axis = axis_[i];
    is_even = paces_[i].isKept(axis.asked()) && is_even && axis.mode() == AxisMode::kFollow;
  }
  for (uint8_t i = 0; i < kZAxis; ++i) slip_watches_[i].measure(axis_[i].duty());
  for (uint8_t i = 0; i < kZAxis; ++i) {
    const bool is_alone = is_even && !slip_watches_[1 - i].isRestless();
    if (slip_watches_[i].look(is_alone && motion::Pace::moves(axis_[i].asked())))
      slips_[i] = uint8_t(slips_[i] + 1);
  }
}

bool Axes::hasYielded() {
  const bool has = has_yielded_;
  has_yielded_ = false;
  return has;
}

bool Axes::prepare(const settings::Values& values) {
  const WithoutTicks hold(clock_);
  bool is_rescaled = false;
  for (TickedAxis& axis : axis_)
    is_rescaled = axis.prepare(values, seconds_per_tick_) || is_rescaled;
  yield_.tune(values.at(kPositionErrorLimit));
  return is_rescaled;
}

bool Axes::isEmpty() const {
  const WithoutTicks hold(clock_);
  return set_points_.isEmpty() && playback_.isDone() && lift_.isAtRest();
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

bool Axes::isZNear() {
  const float kNear = 0.04f, kNearer = 0.01f;  // [mm]
  const uint32_t kPatience = 500;              // [ms] a motor without power never comes nearer
  if (!isEmpty()) {
    nearest_z_ = 0;
    return false;
  }
  const float off = float(fabs(error(kZAxis)));
  const uint32_t now = clock_.milliseconds();
  if (off > nearest_z_ || off < nearest_z_ - kNearer) {
    nearest_z_ = off;
    nearest_ms_ = now;
  }
  return off < kNear || now - nearest_ms_ > kPatience;
}

void Axes::goAt(uint16_t share) {
  const WithoutTicks hold(clock_);
  playback_.goAt(share);
}

void Axes::lift(float z, float speed, float acceleration) {
  const WithoutTicks hold(clock_);
  liftTo(motion::toCounts(withinTravel(z)) - plannedHeight(), speed, acceleration);
}

void Axes::lower(float speed, float acceleration) {
  const WithoutTicks hold(clock_);
  liftTo(0, speed, acceleration);
}

void Axes::liftTo(int32_t goal, float speed, float acceleration) {
  lift_.goTo(goal, motion::toCounts(speed * seconds_per_tick_),
             motion::toCounts(acceleration * seconds_per_tick_ * seconds_per_tick_));
}

bool Axes::isLifted() const {
  const WithoutTicks hold(clock_);
  return lift_.at() != 0 || lift_.goal() != 0;
}

float Axes::plannedZ() const {
  const WithoutTicks hold(clock_);
  return motion::toMm<float>(plannedHeight());
}

float Axes::liftedTo() const {
  const WithoutTicks hold(clock_);
  return motion::toMm<float>(plannedHeight() + lift_.goal());
}

void Axes::declareLifted(float z) {
  const WithoutTicks hold(clock_);
  const int32_t planned = plannedHeight();
  axis_[kZAxis].declare(z);
  lift_.standAt(axis_[kZAxis].setPoint() - planned);
}

}  // namespace machine
