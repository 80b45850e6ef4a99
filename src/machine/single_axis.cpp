// Moves of one axis alone, in its own length: calibration moves and the probe.
#include "machine.h"
#include "ramp.h"

namespace machine {
namespace {

int32_t& partOf(SetPoint& point, Axis axis) {
  if (axis == kLeftAxis) return point.left;
  return axis == kRightAxis ? point.right : point.z;
}

}  // namespace

bool Machine::moveAxis(Axis axis, float goal, float feed, bool until_probe) {
  if (!drain() || !wakeMotors()) return false;
  SetPoint point = axes_.setPoint();
  int32_t& part = partOf(point, axis);
  const float gain = values_.at(axis == kZAxis ? kAccelerationZ : kAccelerationXy);
  Ramp ramp(motion::toMm<float>(part), goal, feed / 60, gain);
  const float tick = axes_.secondsPerTick();
  bool touched = false;
  while (!ramp.isThere() && !touched && !isHalted()) {
    if (stopping_) ramp.brake();
    if (axes_.hasRoom()) {
      part = motion::toCounts(ramp.advance(tick));
      axes_.push(point);
    }
    touched = until_probe && aux_.probeTouches();
    service();
  }
  const float touched_at = axes_.length(axis);
  if (touched) axes_.dropSetPoints();
  while (!axes_.isEmpty() && !isHalted()) service();
  settle();
  // The axis ran on for a moment.
  if (touched) axes_.declare(axis, axes_.length(axis) - touched_at);
  mover_.standAt(axes_.setPoint());
  return !stopping_ && (touched || !until_probe);
}

}  // namespace machine
