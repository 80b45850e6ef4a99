// Motors driven without their loops: B04 tests each motor, B11 pulls a chain tight.
#include "axis_tests.h"

namespace machine {
namespace {

const int32_t kPassCounts = 500;
const uint16_t kRampMs = 500, kHoldMs = 2000;

}  // namespace

bool AxisTests::driveFor(Axis axis, int16_t duty, uint32_t ms) {
  axes_.driveOpen(axis, duty);
  const bool completed = waiting_.waitFor(ms);
  return completed;
}

bool AxisTests::rampMotor(Axis axis, int8_t sign) {
  const uint8_t steps = 50;
  for (uint8_t i = 1; i <= steps; ++i)
    if (!driveFor(axis, int16_t(sign * (255 * i / steps)), kRampMs / steps)) return false;
  if (!driveFor(axis, int16_t(sign * 255), kHoldMs)) return false;
  for (uint8_t i = steps; i-- != 0;)
    if (!driveFor(axis, int16_t(sign * (255 * i / steps)), kRampMs / steps)) return false;
  return true;
}

bool AxisTests::testDirection(Axis axis, int8_t direction) {
  const int32_t before = axes_.counts(axis);
  const int8_t sign = direction == 1 ? 1 : -1;
  if (!rampMotor(axis, sign)) return false;
  // A positive drive winds chain in and must lower the count.
  const int32_t wound = (before - axes_.counts(axis)) * sign;
  out_ << FLASH("Direction ") << int32_t(direction);
  out_.line(wound > kPassCounts ? FLASH(" - Pass") : FLASH(" - Fail"));
  return true;
}

bool AxisTests::testMotors() {
  if (!waiting_.drain() || !motors_.wake()) return false;
  bool completed = true;
  for (uint8_t i = 0; i < kAxisCount && completed; ++i) {
    out_ << FLASH("Testing ") << (i == kLeftAxis ? 'L' : i == kRightAxis ? 'R' : 'Z');
    out_.line(FLASH(" motor:"));
    completed = testDirection(Axis(i), 1) && testDirection(Axis(i), 2);
    axes_.release(Axis(i));
  }
  if (completed) out_.line(FLASH("Tests complete."));
  waiting_.awaitStandstill();
  place_.search();
  return completed;
}

bool AxisTests::pullChain(Axis axis, int16_t duty, float seconds) {
  if (!waiting_.drain() || !motors_.wake()) return false;
  const bool completed = driveFor(axis, duty, uint32_t(seconds * 1000));
  axes_.release(axis);
  waiting_.awaitStandstill();
  place_.search();
  return completed;
}

}  // namespace machine
