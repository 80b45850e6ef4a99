// Where the axes are: lengths and counts, as measured and as declared, and the faults that prove
// them wrong.
#include "axes.h"

namespace machine {

float Axes::length(Axis axis) const {
  const WithoutTicks hold(clock_);
  return axis_[axis].length();
}

float Axes::target(Axis axis) const {
  const WithoutTicks hold(clock_);
  return motion::toMm<float>(axis_[axis].setPoint());
}

float Axes::error(Axis axis) const {
  const WithoutTicks hold(clock_);
  return motion::toMm<float>(axis_[axis].error());
}

float Axes::mostBehind(Axis axis) {
  const WithoutTicks hold(clock_);
  return motion::toMm<float>(axis_[axis].mostBehind());
}

SetPoint Axes::setPoint() const {
  const WithoutTicks hold(clock_);
  return {axis_[kLeftAxis].setPoint(), axis_[kRightAxis].setPoint(), axis_[kZAxis].setPoint()};
}

void Axes::declare(Axis axis, float length) {
  const WithoutTicks hold(clock_);
  lift_.absorb();
  axis_[axis].declare(length);
}

void Axes::jumpTo(Axis axis, float length) {
  const WithoutTicks hold(clock_);
  forgetWay();
  axis_[axis].setSetPoint(motion::toCounts(withinTravel(length)));
}

void Axes::standStill() {
  const WithoutTicks hold(clock_);
  forgetWay();
  for (TickedAxis& axis : axis_) axis.standStill();
}

int32_t Axes::counts(Axis axis) const {
  const WithoutTicks hold(clock_);
  return axis_[axis].counts();
}

void Axes::setCounts(int32_t left, int32_t right, int32_t z) {
  const WithoutTicks hold(clock_);
  releaseAll();
  axis_[kLeftAxis].setCounts(left);
  axis_[kRightAxis].setCounts(right);
  axis_[kZAxis].setCounts(z);
  standStill();
}

void Axes::forgetRawCounts() {
  const WithoutTicks hold(clock_);
  for (TickedAxis& axis : axis_) axis.forgetRawCount();
}

AxisState Axes::state(Axis axis) const {
  const WithoutTicks hold(clock_);
  return axis_[axis].state();
}

Axes::AxisFault Axes::fault() {
  const WithoutTicks hold(clock_);
  AxisFault worst = {motion::Fault::kNone, kLeftAxis};
  for (uint8_t i = 0; i < kAxisCount; ++i) {
    const motion::Fault seen = axis_[i].fault();
    if (seen > worst.fault) worst = {seen, Axis(i)};
  }
  return worst;
}

}  // namespace machine
