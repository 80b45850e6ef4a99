// B codes: calibration, tests and questions of the published programs.
#pragma once

#include "b_lines.h"
#include "parts.h"

namespace machine {

/// Lines with a B.
class BCodes {
 public:
  explicit BCodes(Parts& parts) : parts_(parts) {}

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
  bool setChainsToMarks(uint8_t, const gcode::Words&) {
    return parts_.single_axis.setChainsToMarks();
  }
  bool moveChains(uint8_t, const gcode::Words& words) {
    return parts_.single_axis.moveChains(words);
  }
  bool measureChain(uint8_t, const gcode::Words& words);
  bool pullChain(uint8_t, const gcode::Words& words);
  bool testLoop(uint8_t code, const gcode::Words& words);
  bool goHome(uint8_t, const gcode::Words&) { return parts_.single_axis.goHome(); }
  bool setZLimit(uint8_t code, const gcode::Words&) { return parts_.z.setLimit(code == 17); }
  bool clearZLimits(uint8_t, const gcode::Words&) { return parts_.z.clearLimits(); }
  bool showZLimits(uint8_t, const gcode::Words&) { return parts_.z.showLimits(); }
  bool tellTelemetry(uint8_t, const gcode::Words&);
  /// B99: only the word ON simulates the motors.
  bool switchMotors(const char* word);
  bool simulateMotors(bool on);
  /// Waits until the settings in force outlive a power cut; false after a stop.
  bool awaitStored();

  Parts& parts_;
};

}  // namespace machine
