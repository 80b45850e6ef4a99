// Tests of the loops: B13 sets speeds, B14 lengths, B16 duties, and each reports what the axis did.
#include "axis_tests.h"

namespace machine {
namespace {

const uint16_t kSampleMs = 10;  // the published interval of B13 and B14
const uint16_t kStepMs = 2000;  // for a speed; for a length too, unless T says otherwise
const uint16_t kDutyMs = 200, kDutySampleMs = 50;

/// The value of step i, evenly spaced from the first value to the last.
float stepOf(const LoopTest& test, uint8_t i) {
  if (test.steps < 2) return test.first;
  return test.first + (test.last - test.first) * float(i) / float(test.steps - 1);
}

}  // namespace

void AxisTests::sayGains(Axis axis, bool position) {
  const uint8_t first =
      uint8_t((axis == kZAxis ? kZPositionP : kMainPositionP) + (position ? 0 : 4));
  const char names[] = "pid";
  for (uint8_t i = 0; i < 3; ++i) {
    if (i != 0) base_.out << ',';
    base_.out << 'K' << names[i] << '=';
    base_.out.fixed(base_.values.at(uint8_t(first + i)), 4);
  }
  base_.out.end();
}

bool AxisTests::testLoop(uint8_t code, const LoopTest& test) {
  is_testing_ = true;
  const bool completed = base_.waiting.drain() && motors_.wake() && runLoopTest(code, test);
  is_testing_ = false;
  return completed;
}

bool AxisTests::runLoopTest(uint8_t code, const LoopTest& test) {
  const FlashText name = code == 13   ? FLASH("--PID Velocity Test ")
                         : code == 14 ? FLASH("--PID Position Test ")
                                      : FLASH("--Voltage Test ");
  base_.out << name;
  base_.out.line(FLASH("Start--"));
  const bool completed = code == 13   ? testSpeeds(test)
                         : code == 14 ? testLengths(test)
                                      : testDuties(test);
  base_.axes.release(test.axis);
  base_.out << name;
  base_.out.line(FLASH("Stop--"));
  base_.out.end();
  lookAgain();
  return completed;
}

bool AxisTests::sampleSpeed(Axis axis, float rpm, uint8_t version) {
  base_.axes.turn(axis, rpm);
  for (uint16_t ms = 0; ms < kStepMs; ms += kSampleMs) {
    if (!base_.waiting.waitFor(kSampleMs)) return false;
    const AxisState state = base_.axes.state(axis);
    if (version == 2) {
      base_.out.fixed(rpm, 4) << ',';
      base_.out.fixed(state.rpm, 4) << ',';
      base_.out << int32_t(state.duty);
    } else {
      base_.out.fixed(rpm - state.rpm, 4);
    }
    base_.out.end();
  }
  return true;
}

bool AxisTests::testSpeeds(const LoopTest& test) {
  sayGains(test.axis, false);
  if (test.version == 2) base_.out.line(FLASH("setpoint,input,output"));
  bool completed = true;
  for (uint8_t i = 0; i < test.steps && completed; ++i)
    completed = sampleSpeed(test.axis, stepOf(test, i), test.version);
  return completed;
}

bool AxisTests::sampleLength(Axis axis, float goal, uint16_t ms, uint8_t version) {
  base_.axes.jumpTo(axis, goal);
  for (uint16_t at = 0; at < ms; at = uint16_t(at + kSampleMs)) {
    if (!base_.waiting.waitFor(kSampleMs)) return false;
    const AxisState state = base_.axes.state(axis);
    const float is = base_.axes.length(axis);
    if (version == 2) {
      base_.out.fixed(goal, 4) << ',';
      base_.out.fixed(is, 4) << ',';
      base_.out.fixed(state.wanted_rpm, 4) << ',';
      base_.out.fixed(state.rpm, 4) << ',';
      base_.out.fixed(state.duty, 4);
    } else {
      base_.out.fixed(goal - is, 4);
    }
    base_.out.end();
  }
  return true;
}

bool AxisTests::testLengths(const LoopTest& test) {
  sayGains(test.axis, true);
  if (test.version == 2) base_.out.line(FLASH("setpoint,input,output,rpminput,voltage"));
  const float from = base_.axes.length(test.axis);
  bool completed = true;
  for (uint8_t i = 0; i < test.steps && completed; ++i)
    completed = sampleLength(test.axis, from + stepOf(test, i),
                             test.step_ms ? test.step_ms : kStepMs, test.version);
  return completed;
}

bool AxisTests::testDuties(const LoopTest& test) {
  const int16_t last = int16_t(test.last), step = test.last < test.first ? -1 : 1;
  bool completed = true;
  for (int16_t duty = int16_t(test.first); completed; duty = int16_t(duty + step)) {
    base_.axes.driveOpen(test.axis, duty);
    for (uint16_t ms = 0; ms < kDutyMs && completed; ms += kDutySampleMs) {
      completed = base_.waiting.waitFor(kDutySampleMs);
      if (!completed) break;
      base_.out << int32_t(duty) << ',';
      base_.out.fixed(base_.axes.state(test.axis).rpm, 4).end();
    }
    if (duty == last) break;
  }
  return completed;
}

}  // namespace machine
