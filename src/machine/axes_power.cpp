// Which motors have power, and what drives them.
#include "axes.h"

namespace machine {

void Axes::follow() {
  const WithoutTicks hold(clock_);
  for (Controlled& controlled : axis_) {
    if (controlled.mode == AxisMode::kFollow) continue;
    controlled.loop.rest();
    controlled.watch.rest();
    controlled.mode = AxisMode::kFollow;
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
  Controlled& controlled = axis_[axis];
  if (controlled.mode != AxisMode::kTurn) controlled.loop.rest();
  controlled.mode = AxisMode::kTurn;
  controlled.rpm = rpm;
}

bool Axes::isPowered() const {
  for (const Controlled& controlled : axis_)
    if (controlled.mode != AxisMode::kOff) return true;
  return false;
}

bool Axes::isTurning() const {
  const WithoutTicks hold(clock_);
  for (const Controlled& controlled : axis_)
    if (controlled.moved > 1 || controlled.moved < -1) return true;
  return false;
}

bool Axes::isDriven() const {
  for (const Controlled& controlled : axis_)
    if (controlled.mode == AxisMode::kOpen || controlled.mode == AxisMode::kTurn) return true;
  return false;
}

}  // namespace machine
