// Which motors have power, what drives them, and whether they are simulated.
#include "axes.h"

namespace machine {

void Axes::follow() {
  const WithoutTicks hold(clock_);
  for (TickedAxis& axis : axis_) axis.follow();
}

void Axes::release(Axis axis) {
  const WithoutTicks hold(clock_);
  axis_[axis].release();
}

void Axes::releaseAll() {
  for (uint8_t i = 0; i < kAxisCount; ++i) release(Axis(i));
}

void Axes::brakeAll() {
  const float kBrakes = 0.5f;  // [s] the fastest motor stands long before
  const WithoutTicks hold(clock_);
  for (TickedAxis& axis : axis_) axis.brake(uint8_t(kBrakes / seconds_per_tick_));
}

void Axes::driveOpen(Axis axis, int16_t duty) {
  const WithoutTicks hold(clock_);
  axis_[axis].driveOpen(duty);
}

void Axes::turn(Axis axis, float rpm) {
  const WithoutTicks hold(clock_);
  axis_[axis].turn(rpm);
}

bool Axes::isPowered() const {
  for (const TickedAxis& axis : axis_)
    if (axis.mode() != AxisMode::kOff) return true;
  return false;
}

bool Axes::isTurning() const {
  const WithoutTicks hold(clock_);
  for (const TickedAxis& axis : axis_)
    if (axis.isTurning()) return true;
  return false;
}

bool Axes::isDriven() const {
  for (const TickedAxis& axis : axis_)
    if (axis.mode() == AxisMode::kOpen || axis.mode() == AxisMode::kTurn) return true;
  return false;
}

void Axes::simulate(bool on) {
  const WithoutTicks hold(clock_);
  for (TickedAxis& axis : axis_) axis.simulate(on);
}

bool Axes::isImagined() const {
  for (const TickedAxis& axis : axis_)
    if (axis.isImagined()) return true;
  return false;
}

}  // namespace machine
