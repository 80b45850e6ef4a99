// B codes: calibration, tests and questions of the published programs.
#pragma once

#include "axis_tests.h"
#include "b_lines.h"
#include "greeting.h"
#include "new_values.h"
#include "single_axis.h"
#include "telemetry.h"

namespace machine {

/// Lines with a B.
class BCodes {
 public:
  BCodes(Basis& basis, Greeting& greeting, SledPlace& place, Telemetry& telemetry,
         MotorPower& motors, ZAxis& z, NewValues& new_values, SingleAxis& single_axis,
         AxisTests& axis_tests)
      : base_(basis),
        greeting_(greeting),
        place_(place),
        telemetry_(telemetry),
        motors_(motors),
        z_(z),
        new_values_(new_values),
        single_axis_(single_axis),
        axis_tests_(axis_tests) {}

  /// Does a line, which is clean.
  bool run(const char* line);

 private:
  typedef bool (BCodes::*Run)(uint8_t code, const gcode::Words& words);
  struct Code;

  bool sayVersion(uint8_t, const gcode::Words&);
  bool sayNoCalibration(uint8_t, const gcode::Words&);
  bool measureOut(uint8_t, const gcode::Words& words);
  /// Gives the motors power for a test that drives them in a hold too: it begins after the hold.
  bool wakeForTest();
  bool testMotors(uint8_t, const gcode::Words&);
  bool setChains(uint8_t, const gcode::Words& words);
  bool setChainsToMarks(uint8_t, const gcode::Words&) { return single_axis_.setChainsToMarks(); }
  bool moveChains(uint8_t, const gcode::Words& words) { return single_axis_.moveChains(words); }
  bool measureChain(uint8_t, const gcode::Words& words);
  bool pullChain(uint8_t, const gcode::Words& words);
  bool testLoop(uint8_t code, const gcode::Words& words);
  bool goHome(uint8_t, const gcode::Words&) { return single_axis_.goHome(); }
  bool setZLimit(uint8_t code, const gcode::Words&) { return z_.setLimit(code == 17); }
  bool clearZLimits(uint8_t, const gcode::Words&) { return z_.clearLimits(); }
  bool showZLimits(uint8_t, const gcode::Words&) { return z_.showLimits(); }
  bool tellTelemetry(uint8_t, const gcode::Words&);
  /// B99: only the word ON simulates the motors.
  bool switchMotors(const char* word);
  bool simulateMotors(bool on);
  /// Waits until the settings in force outlive a power cut; false after a stop.
  bool awaitStored();

  Basis& base_;
  Greeting& greeting_;
  SledPlace& place_;
  Telemetry& telemetry_;
  MotorPower& motors_;
  ZAxis& z_;
  NewValues& new_values_;
  SingleAxis& single_axis_;
  AxisTests& axis_tests_;
};

}  // namespace machine
