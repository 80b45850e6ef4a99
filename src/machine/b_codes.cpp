// Actions of the B codes.
#include "b_codes.h"

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

bool BCodes::run(const char* line) {
  const uint8_t code = bCodeOf(line);
  if (code == 99) return switchMotors(line + 3);
  Words words;
  if (code != 255 && !isBare(code)) {
    const gcode::Mistake mistake = gcode::findMistake(line + 3, bareLetters(code));
    if (mistake.fault != gcode::Fault::kNone) return parts_.answers.refuseMistake(mistake);
    gcode::Word word;
    for (const char* at = line + 3; gcode::readWord(at, word);) words.add(word.letter, word.value);
  }
  // All codes but questions act on the machine, so moves that were queued before come first. A line
  // of the operator during a wait acts at once.
  if (!isQuestion(code)) {
    if (!parts_.answers.isServing()) {
      if (!parts_.waiting.drain()) return false;
      parts_.new_values.refreshBeforeLine();
    }
    if ((code == 2 || code == 11) && !words.has('L') && !words.has('R'))
      return parts_.answers.refuse(FLASH("B02 and B11 need a chain: L or R"));
    if (!SingleAxis::isLength(words.value('L')) || !SingleAxis::isLength(words.value('R')))
      return parts_.answers.refuseMotion(tooLongForChains());
  }
  return runCode(code, words);
}

bool BCodes::runCode(uint8_t code, const Words& words) {
  switch (code) {
    case 1:
      parts_.out.line(FLASH("Motor Calibration Not Needed"));
      return true;
    case 2:
      return parts_.single_axis.measureOut(words.value('L') != 0 ? kLeftAxis : kRightAxis);
    case 4:
      return wakeForTest() && parts_.axis_tests.testMotors();
    case 5:
      parts_.out.line(FLASH("Firmware Version 1.28"));
      return true;
    case 6:
      return setChains(words);
    case 8:
      return parts_.single_axis.setChainsToMarks();
    case 9:
      return parts_.single_axis.moveChains(words);
    case 10:
      return parts_.single_axis.measureChain(words.has('L'));
    case 11:
      return pullChain(words);
    case 13:
    case 14:
    case 16:
      return testLoop(code, words);
    case 15:
      return parts_.single_axis.goHome();
    case 17:
    case 18:
      return parts_.z.setLimit(code == 17);
    case 19:
      return parts_.z.clearLimits();
    case 20:
      return parts_.z.showLimits();
    case 30:
      parts_.telemetry.tell();
      return true;
    default:
      return parts_.answers.refuseStatement();
  }
}

bool BCodes::setChains(const Words& words) {
  if (!words.has('L') || !words.has('R'))
    return parts_.answers.refuseWords(FLASH("B06 needs the lengths of both chains, L and R"));
  if (!parts_.single_axis.mayHang(words.value('L'), words.value('R'))) return false;
  parts_.out.line(FLASH("Setting Chain Lengths To: "));
  return parts_.single_axis.setChains(words.value('L'), words.value('R'));
}

bool BCodes::wakeForTest() { return parts_.motors.wake() && parts_.waiting.untilRunning(); }

bool BCodes::pullChain(const Words& words) {
  const float duty = words.has('S') ? words.value('S') : 100;
  const float seconds = words.has('T') ? words.value('T') : 1;
  if (!(fabs(duty) <= 255 && seconds >= 0 && seconds <= 60))
    return parts_.answers.refuse(FLASH("S is -255 to 255, T at most 60 s"));
  if (!wakeForTest()) return false;
  return parts_.axis_tests.pullChain(words.has('L') ? kLeftAxis : kRightAxis, int16_t(duty),
                                     seconds);
}

bool BCodes::testLoop(uint8_t code, const Words& words) {
  LoopTest test = {testedAxis(words), words.value('S'), words.value('F'), 1, 0, 1};
  const float steps = words.value('I'), step_ms = words.value('T');
  test.steps = steps >= 1 && steps <= 200 ? uint8_t(steps) : 1;
  test.step_ms = step_ms >= 20 && step_ms <= 60000 ? uint16_t(step_ms) : 0;
  if (words.value('V') == 2) test.version = 2;
  if (!isMild(code, test.first) || !isMild(code, test.last))
    return parts_.answers.refuse(FLASH("S and F are at most 255, of B14 at most 1000"));
  return parts_.axis_tests.testLoop(code, test);
}

bool BCodes::switchMotors(const char* word) {
  if (strncmp_P(word, PSTR("ON"), 3) == 0) return simulateMotors(true);
  if (*word == '\0' || strncmp_P(word, PSTR("OFF"), 4) == 0) return simulateMotors(false);
  return parts_.answers.refuse(FLASH("B99 is ON or OFF"));
}

bool BCodes::simulateMotors(bool on) {
  if (!parts_.waiting.drain()) return false;
  parts_.axes.releaseAll();
  const bool was_on = parts_.axes.isSimulated();
  if (on && !was_on && !parts_.motors.awaitRecord()) return false;
  parts_.memory.setRow(kSimulatedMotors, on);
  parts_.axes.simulate(on);
  parts_.greeting.sayMotors(on);
  if (was_on && !on && parts_.axes.isImagined()) parts_.place.lose(settings::Doubt::kSimulated);
  return awaitStored();
}

bool BCodes::awaitStored() {
  const uint32_t kMostMs = 4000;  // to write all settings takes 3 s
  const uint32_t start = parts_.clock.milliseconds();
  return parts_.waiting.waitWhile([&] {
    return !parts_.memory.settingsStored() && !parts_.memory.isWorn() &&
           parts_.clock.milliseconds() - start < kMostMs;
  });
}

}  // namespace machine
