// What each B code does: calibration, tests and questions of the published programs.
#include "b_lines.h"
#include "machine.h"

namespace machine {
namespace {

using gcode::Words;

const float kMostTestLength = 1000;  // [mm]

/// Codes that read no words, or only whether letters are there.
bool isBare(uint8_t code) { return code == 5 || code == 20 || code == 30 || code == 99; }

/// Letters that need no number behind them.
const char* bareLetters(uint8_t code) { return code == 10 || code == 11 ? "LR" : ""; }

/// Whether a value is safe for a test: turns a minute for B13, mm for B14, a duty for B16.
bool isMild(uint8_t code, float value) {
  return float(fabs(value)) <= (code == 14 ? kMostTestLength : 255);
}

Axis testedAxis(const Words& words) {
  if (words.has('L') && words.value('L') != 0) return kLeftAxis;
  return words.has('Z') && words.value('Z') != 0 ? kZAxis : kRightAxis;
}

}  // namespace

/// A code and the function that does it.
struct Machine::BCode {
  uint8_t code;
  RunB run;
};

bool Machine::runB(const char* line) {
  static const BCode kCodes[] PROGMEM = {
      {1, &Machine::sayNoCalibration}, {2, &Machine::measureOut},
      {4, &Machine::testMotors},       {5, &Machine::sayVersion},
      {6, &Machine::setChains},        {8, &Machine::setChainsToMarks},
      {9, &Machine::moveChains},       {10, &Machine::measureChain},
      {11, &Machine::pullChain},       {13, &Machine::testLoop},
      {14, &Machine::testLoop},        {15, &Machine::goHome},
      {16, &Machine::testLoop},        {17, &Machine::setZLimit},
      {18, &Machine::setZLimit},       {19, &Machine::clearZLimits},
      {20, &Machine::showZLimits},     {30, &Machine::tellTelemetry},
  };
  const uint8_t code = bCodeOf(line);
  if (code == 99) return switchMotors(line + 3);
  Words words;
  if (code != 255 && !isBare(code)) {
    const gcode::Mistake mistake = gcode::findMistake(line + 3, bareLetters(code));
    if (mistake.fault != gcode::Fault::kNone) return base_.answers.refuseMistake(mistake);
    gcode::Word word;
    for (const char* at = line + 3; gcode::readWord(at, word);) words.add(word.letter, word.value);
  }
  // All codes but questions act on the machine, so moves that were queued before come first. A line
  // of the operator during a wait acts at once.
  if (!isQuestion(code)) {
    if (!base_.answers.isServing()) {
      if (!drain()) return false;
      new_values_.refreshBeforeLine();
    }
    if ((code == 2 || code == 11) && !words.has('L') && !words.has('R'))
      return base_.answers.refuse(FLASH("B02 and B11 need a chain: L or R"));
    if (!SingleAxis::isLength(words.value('L')) || !SingleAxis::isLength(words.value('R')))
      return base_.answers.refuseMotion(tooLongForChains());
  }
  for (uint8_t i = 0; i < sizeof kCodes / sizeof kCodes[0]; ++i) {
    BCode found;
    memcpy_P(&found, kCodes + i, sizeof found);
    if (found.code == code) return (this->*found.run)(code, words);
  }
  return base_.answers.refuseStatement();
}

bool Machine::sayVersion(uint8_t, const Words&) {
  base_.out.line(FLASH("Firmware Version 1.28"));
  return true;
}

bool Machine::sayNoCalibration(uint8_t, const Words&) {
  base_.out.line(FLASH("Motor Calibration Not Needed"));
  return true;
}

bool Machine::measureOut(uint8_t, const Words& words) {
  return single_axis_.measureOut(words.value('L') != 0 ? kLeftAxis : kRightAxis);
}

bool Machine::setChains(uint8_t, const Words& words) {
  if (!words.has('L') || !words.has('R'))
    return base_.answers.refuseWords(FLASH("B06 needs the lengths of both chains, L and R"));
  if (!single_axis_.mayHang(words.value('L'), words.value('R'))) return false;
  base_.out.line(FLASH("Setting Chain Lengths To: "));
  return single_axis_.setChains(words.value('L'), words.value('R'));
}

bool Machine::measureChain(uint8_t, const Words& words) {
  return single_axis_.measureChain(words.has('L'));
}

bool Machine::wakeForTest() { return motors_.wake() && untilRunning(); }

bool Machine::testMotors(uint8_t, const Words&) {
  return wakeForTest() && axis_tests_.testMotors();
}

bool Machine::pullChain(uint8_t, const Words& words) {
  const float duty = words.has('S') ? words.value('S') : 100;
  const float seconds = words.has('T') ? words.value('T') : 1;
  if (!(fabs(duty) <= 255 && seconds >= 0 && seconds <= 60))
    return base_.answers.refuse(FLASH("S is -255 to 255, T at most 60 s"));
  if (!wakeForTest()) return false;
  return axis_tests_.pullChain(words.has('L') ? kLeftAxis : kRightAxis, int16_t(duty), seconds);
}

bool Machine::testLoop(uint8_t code, const Words& words) {
  LoopTest test = {testedAxis(words), words.value('S'), words.value('F'), 1, 0, 1};
  const float steps = words.value('I'), step_ms = words.value('T');
  test.steps = steps >= 1 && steps <= 200 ? uint8_t(steps) : 1;
  test.step_ms = step_ms >= 20 && step_ms <= 60000 ? uint16_t(step_ms) : 0;
  if (words.value('V') == 2) test.version = 2;
  if (!isMild(code, test.first) || !isMild(code, test.last))
    return base_.answers.refuse(FLASH("S and F are at most 255, of B14 at most 1000"));
  return axis_tests_.testLoop(code, test);
}

bool Machine::tellTelemetry(uint8_t, const Words&) {
  telemetry_.tell();
  return true;
}

bool Machine::switchMotors(const char* word) {
  if (strncmp_P(word, PSTR("ON"), 3) == 0) return simulateMotors(true);
  if (*word == '\0' || strncmp_P(word, PSTR("OFF"), 4) == 0) return simulateMotors(false);
  return base_.answers.refuse(FLASH("B99 is ON or OFF"));
}

bool Machine::simulateMotors(bool on) {
  if (!drain()) return false;
  base_.axes.releaseAll();
  const bool was_on = base_.axes.isSimulated();
  if (on && !was_on && !motors_.awaitRecord()) return false;
  base_.memory.setRow(kSimulatedMotors, on);
  base_.axes.simulate(on);
  greeting_.sayMotors(on);
  if (was_on && !on && base_.axes.isImagined()) place_.lose(settings::Doubt::kSimulated);
  return awaitStored();
}

bool Machine::awaitStored() {
  const uint32_t kMostMs = 4000;  // to write all settings takes 3 s
  const uint32_t start = base_.clock.milliseconds();
  return waitWhile([&] {
    return !base_.memory.settingsStored() && !base_.memory.isWorn() &&
           base_.clock.milliseconds() - start < kMostMs;
  });
}

}  // namespace machine
