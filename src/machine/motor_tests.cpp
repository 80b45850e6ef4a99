// Motors driven without their loops: B04 tests each motor, B11 pulls a chain tight.
#include "parts.h"

namespace machine {
namespace {

const int32_t kPassCounts = 500;
const uint16_t kRampMs = 500, kHoldMs = 2000;

}  // namespace

bool AxisTests::driveFor(Axis axis, int16_t duty, uint32_t ms) {
  parts_.axes.driveOpen(axis, duty);
  return parts_.waiting.waitFor(ms);
}

/// A test is over: works out where it left the sled.
void AxisTests::lookAgain() {
  parts_.waiting.awaitStandstill();
  parts_.place.search(Search::kChainsDriven);
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
  const int32_t before = parts_.axes.counts(axis);
  const int8_t sign = direction == 1 ? 1 : -1;
  if (!rampMotor(axis, sign)) return false;
  // A positive drive winds chain in and must lower the count.
  const int32_t wound = (before - parts_.axes.counts(axis)) * sign;
  if (wound <= kPassCounts) parts_.keeper.doubt(axis, settings::Doubt::kCounts);
  parts_.out << FLASH("Direction ") << int32_t(direction);
  parts_.out.line(wound > kPassCounts ? FLASH(" - Pass") : FLASH(" - Fail"));
  return true;
}

bool AxisTests::testMotors() {
  if (!parts_.waiting.drain() || !parts_.motors.wake()) return false;
  bool completed = true;
  for (uint8_t i = 0; i < kAxisCount && completed; ++i) {
    parts_.out << FLASH("Testing ") << (i == kLeftAxis ? 'L' : i == kRightAxis ? 'R' : 'Z');
    parts_.out.line(FLASH(" motor:"));
    completed = testDirection(Axis(i), 1) && testDirection(Axis(i), 2);
    parts_.axes.release(Axis(i));
  }
  if (completed) parts_.out.line(FLASH("Tests complete."));
  lookAgain();
  return completed;
}

bool AxisTests::pullChain(Axis axis, int16_t duty, float seconds) {
  const float kMeasured = 2;       // [s] a shorter pull has no time to measure
  const int16_t kGentleDuty = 95;  // a motor at rest pulls with about 100 N
  if (!parts_.waiting.drain() || !parts_.motors.wake()) return false;
  const uint32_t ms = uint32_t(seconds * 1000);
  bool completed = true;
  if (duty > 0 && seconds >= kMeasured)
    completed = measureTaut(axis, duty, ms);
  else
    completed = driveFor(axis, duty < kGentleDuty ? duty : kGentleDuty, ms);
  parts_.axes.release(axis);
  lookAgain();
  return completed;
}

bool AxisTests::measureTaut(Axis axis, int16_t most_duty, uint32_t ms) {
  ChainPull pull(parts_.axes, parts_.waiting, axis, most_duty);
  const ChainPull::Result result = pull.run(ms);
  parts_.axes.release(axis);
  switch (result) {
    case ChainPull::Result::kStopped:
      return false;
    case ChainPull::Result::kTaut:
      sayGap(pull);
      break;
    case ChainPull::Result::kSlack:
      parts_.out.line(
          FLASH("The chain is not tight yet: hook it on the other sprocket, send B11 again."));
      break;
    case ChainPull::Result::kDead:
      parts_.keeper.doubt(axis, settings::Doubt::kCounts);
      parts_.out << (axis == kLeftAxis ? FLASH("The left") : FLASH("The right"));
      parts_.out.line(FLASH(" motor hardly turns: check its supply, its cables and its encoder."));
      break;
  }
  return true;
}

void AxisTests::sayGap(const ChainPull& pull) {
  const float kMostSpread = 0.5f;     // [mm]
  const float kPastSprocket = 12.7f;  // [mm] of links, as the clients count them
  parts_.out << FLASH("Motor gap ");
  parts_.out.fixed(pull.length() - kPastSprocket, 2) << FLASH(" mm before sag and flex, spread ");
  parts_.out.fixed(pull.spread(), 2) << FLASH(" mm, ") << int32_t(pull.pulls());
  parts_.out << (pull.pulls() == 1 ? FLASH(" pull") : FLASH(" pulls"));
  parts_.out << FLASH(" with about ") << int32_t(pull.force() + 0.5f);
  parts_.out.line(FLASH(" N."));
  if (pull.spread() > kMostSpread)
    parts_.out.line(FLASH("The pulls differ: look after chain, hook and supply, send B11 again."));
}

}  // namespace machine
