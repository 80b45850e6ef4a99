// B codes: calibration, tests and questions of the published programs.
#pragma once

#include "b_lines.h"
#include "parts.h"

namespace machine {

/// Lines with a B.
class BCodes {
 public:
  explicit BCodes(Parts& parts) : parts_(parts) {}

  /// Runs a cleaned line.
  bool run(const char* line);

 private:
  bool runCode(uint8_t code, const gcode::Words& words);
  /// Gives the motors power for a test that drives them in a hold too: it begins after the hold.
  bool wakeForTest();
  bool setChains(const gcode::Words& words);
  bool pullChain(const gcode::Words& words);
  bool testLoop(uint8_t code, const gcode::Words& words);
  /// B99: only ON simulates the motors.
  bool switchMotors(const char* word);
  bool simulateMotors(bool on);
  /// Waits until the settings in force are stored; false after a stop.
  bool awaitStored();

  Parts& parts_;
};

}  // namespace machine
