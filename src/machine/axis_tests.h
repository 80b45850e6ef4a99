// Single axes without set-points: tests of motors and loops, and pulling a chain tight.
#pragma once

#include "chain_pull.h"
#include "motor_power.h"

namespace machine {

/// A test of an axis' loops, as B13, B14 and B16 ask for it.
struct LoopTest {
  Axis axis;
  float first, last;
  uint8_t steps;
  uint16_t step_ms;
  uint8_t version;  ///< 2: more numbers in each line
};

/// B04, B11, B13, B14 and B16. Each test waits for queued moves and powers the motors. At its end
/// it works out the sled's place again. It returns whether it was completed.
class AxisTests {
 public:
  explicit AxisTests(Parts& parts) : parts_(parts) {}

  /// B04: each motor to and fro, and whether its encoder counts the right way.
  bool testMotors();
  /// B11: pays out a chain at a duty for a while, or winds it in until it is tight, with at most
  /// that duty and a limited force. With time enough it pulls three times and says the motor gap.
  bool pullChain(Axis axis, int16_t duty, float seconds);
  /// B13, B14 and B16.
  bool testLoop(uint8_t code, const LoopTest& test);
  /// Whether a test of the loops is running; it makes errors on purpose.
  bool isTesting() const { return is_testing_; }

 private:
  // motor_tests.cpp
  bool driveFor(Axis axis, int16_t duty, uint32_t ms);
  bool rampMotor(Axis axis, int8_t sign);
  bool testDirection(Axis axis, int8_t direction);
  bool measureTaut(Axis axis, int16_t most_duty, uint32_t ms);
  void sayGap(const ChainPull& pull);
  void lookAgain();
  // loop_tests.cpp
  bool runLoopTest(uint8_t code, const LoopTest& test);
  void sayGains(Axis axis, bool position);
  bool sample(const LoopTest& test, bool is_length, float goal, uint16_t ms);
  bool testSteps(const LoopTest& test, bool is_length);
  bool testDuties(const LoopTest& test);

  Parts& parts_;
  bool is_testing_ = false;
};

}  // namespace machine
