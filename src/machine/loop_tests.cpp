// Tests of the loops: B13 sets speeds, B14 lengths, B16 duties, and each reports what the axis did.
#include "parts.h"

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
    if (i != 0) parts_.out << ',';
    parts_.out << 'K' << names[i] << '=';
    parts_.out.fixed(parts_.values.at(uint8_t(first + i)), 4);
  }
  parts_.out.end();
}

bool AxisTests::testLoop(uint8_t code, const LoopTest& test) {
  is_testing_ = true;
  const bool completed = parts_.waiting.drain() && parts_.motors.wake() && runLoopTest(code, test);
  is_testing_ = false;
  return completed;
}

bool AxisTests::runLoopTest(uint8_t code, const LoopTest& test) {
  const FlashText name = code == 13   ? FLASH("--PID Velocity Test ")
                         : code == 14 ? FLASH("--PID Position Test ")
                                      : FLASH("--Voltage Test ");
  parts_.out << name;
  parts_.out.line(FLASH("Start--"));
  const bool completed = code == 16 ? testDuties(test) : testSteps(test, code == 14);
  parts_.axes.release(test.axis);
  parts_.out << name;
  parts_.out.line(FLASH("Stop--"));
  parts_.out.end();
  lookAgain();
  return completed;
}

/// Sets a length [mm] or a speed [rpm] and says for a while what the axis does.
bool AxisTests::sample(const LoopTest& test, bool is_length, float goal, uint16_t ms) {
  if (is_length)
    parts_.axes.jumpTo(test.axis, goal);
  else
    parts_.axes.turn(test.axis, goal);
  for (uint16_t at = 0; at < ms; at = uint16_t(at + kSampleMs)) {
    if (!parts_.waiting.waitFor(kSampleMs)) return false;
    const AxisState state = parts_.axes.state(test.axis);
    const float is = is_length ? parts_.axes.length(test.axis) : state.rpm;
    if (test.version != 2) {
      parts_.out.fixed(goal - is, 4).end();
      continue;
    }
    parts_.out.fixed(goal, 4) << ',';
    parts_.out.fixed(is, 4) << ',';
    if (is_length) {
      parts_.out.fixed(state.wanted_rpm, 4) << ',';
      parts_.out.fixed(state.rpm, 4) << ',';
      parts_.out.fixed(state.duty, 4).end();
    } else {
      parts_.out << int32_t(state.duty);
      parts_.out.end();
    }
  }
  return true;
}

bool AxisTests::testSteps(const LoopTest& test, bool is_length) {
  sayGains(test.axis, is_length);
  if (test.version == 2)
    parts_.out.line(is_length ? FLASH("setpoint,input,output,rpminput,voltage")
                              : FLASH("setpoint,input,output"));
  const float from = is_length ? parts_.axes.length(test.axis) : 0;
  const uint16_t ms = is_length && test.step_ms ? test.step_ms : kStepMs;
  bool completed = true;
  for (uint8_t i = 0; i < test.steps && completed; ++i)
    completed = sample(test, is_length, from + stepOf(test, i), ms);
  return completed;
}

bool AxisTests::testDuties(const LoopTest& test) {
  const int16_t last = int16_t(test.last), step = test.last < test.first ? -1 : 1;
  bool completed = true;
  for (int16_t duty = int16_t(test.first); completed; duty = int16_t(duty + step)) {
    parts_.axes.driveOpen(test.axis, duty);
    for (uint16_t ms = 0; ms < kDutyMs && completed; ms += kDutySampleMs) {
      completed = parts_.waiting.waitFor(kDutySampleMs);
      if (!completed) break;
      parts_.out << int32_t(duty) << ',';
      parts_.out.fixed(parts_.axes.state(test.axis).rpm, 4).end();
    }
    if (duty == last) break;
  }
  return completed;
}

}  // namespace machine
