// B codes: calibration, tests and questions of the published programs.
#include "machine.h"

namespace machine {
namespace {

const float kAxisFeed = 800;         // [mm/min] unless a command says otherwise
const float kMostTestLength = 1000;  // [mm]

/// The two digits behind the B, or 255.
uint8_t codeOf(const char* line) {
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  if (!digit(line[1]) || !digit(line[2])) return 255;
  return uint8_t((line[1] - '0') * 10 + (line[2] - '0'));
}

bool holds(const char* text, char letter) {
  for (; *text != '\0'; ++text)
    if (*text == letter) return true;
  return false;
}

/// Codes that read no words, or only whether letters are there.
bool isSimple(uint8_t code) { return code == 5 || code == 20 || code == 30 || code == 99; }

/// Letters that need no number behind them.
const char* bareLetters(uint8_t code) { return code == 10 || code == 11 ? "LR" : ""; }

/// Whether a test may go there: turns a minute of B13, mm of B14, duties of B16.
bool isMild(uint8_t code, float value) {
  return float(fabs(value)) <= (code == 14 ? kMostTestLength : 255);
}

bool isLength(float value) { return float(fabs(value)) <= kMostTravel; }

}  // namespace

bool Machine::isQuestion(const char* line) {
  const uint8_t code = codeOf(line);
  return code == 5 || code == 10 || code == 20 || code == 30;
}

bool Machine::isZLimitCode(const char* line) {
  const uint8_t code = codeOf(line);
  return code >= 17 && code <= 19;
}

bool Machine::runB(const char* line) {
  const uint8_t code = codeOf(line);
  Words words;
  if (code != 255 && !isSimple(code)) {
    const gcode::Mistake mistake = gcode::findMistake(line + 3, bareLetters(code));
    if (mistake.fault != gcode::Fault::kNone) return refuseMistake(mistake);
    gcode::Word word;
    for (const char* at = line + 3; gcode::readWord(at, word);) words.add(word.letter, word.value);
  }
  switch (code) {
    case 5:
      out_.line(FLASH("Firmware Version 1.28"));
      return true;
    case 10:
      return measureChain(words.has('L'));
    case 20:
      return showZLimits();
    case 30:
      return tellTelemetry();
    case 99:
      return simulateMotors(holds(line + 3, 'O') && holds(line + 3, 'N'));
    default:
      break;
  }
  // All others act on the machine, so what was queued before them comes first; an operator's line
  // in a wait is for the moment.
  if (!interlude_.isServing()) {
    if (!drain()) return false;
    refreshGeometry();
  }
  return runChainCode(code, words);
}

bool Machine::runChainCode(uint8_t code, const Words& words) {
  const float left = words.value('L'), right = words.value('R');
  if (!isLength(left) || !isLength(right)) return refuseMotion(FLASH("no chain is that long"));
  switch (code) {
    case 1:
      out_.line(FLASH("Motor Calibration Not Needed"));
      return true;
    case 2:
      return measureOut(left != 0 ? kLeftAxis : kRightAxis);
    case 4:
      return testMotors();
    case 6:
      out_.line(FLASH("Setting Chain Lengths To: "));
      return setChains(left, right);
    case 8:
      if (!setChains(values_.at(kExtendLength), values_.at(kExtendLength))) return false;
      out_.line(FLASH("Message: The machine chains have been manually re-calibrated."));
      return true;
    case 9:
      return moveChains(words);
    case 15:
      return goHome();
    default:
      return runTestCode(code, words);
  }
}

bool Machine::runTestCode(uint8_t code, const Words& words) {
  const Axis axis = words.has('L') && words.value('L') != 0   ? kLeftAxis
                    : words.has('Z') && words.value('Z') != 0 ? kZAxis
                                                              : kRightAxis;
  LoopTest test = {axis, words.value('S'), words.value('F'), 1, 0, 1};
  const float steps = words.value('I'), step_ms = words.value('T');
  test.steps = steps >= 1 && steps <= 200 ? uint8_t(steps) : 1;
  test.step_ms = step_ms >= 20 && step_ms <= 60000 ? uint16_t(step_ms) : 0;
  if (words.value('V') == 2) test.version = 2;
  switch (code) {
    case 11:
      return pullByWords(words);
    case 13:
    case 14:
    case 16:
      if (!isMild(code, test.first) || !isMild(code, test.last))
        return refuse(FLASH("S and F are at most 255, of B14 at most 1000"));
      return testLoop(code, test);
    case 17:
    case 18:
      return setZLimit(code == 17);
    case 19:
      return clearZLimits();
    default:
      return refuse(FLASH("Invalid statement"));
  }
}

bool Machine::pullByWords(const Words& words) {
  const float duty = words.has('S') ? words.value('S') : 100;
  const float seconds = words.has('T') ? words.value('T') : 1;
  if (!(fabs(duty) <= 255 && seconds >= 0 && seconds <= 60))
    return refuse(FLASH("S is -255 to 255, T at most 60 s"));
  return pullChain(words.has('L') ? kLeftAxis : kRightAxis, int16_t(duty), seconds);
}

bool Machine::measureOut(Axis axis) {
  if (!isLength(values_.at(kExtendLength)))
    return refuseMotion(FLASH("no chain is that long ($11)"));
  out_.line(axis == kLeftAxis ? FLASH("Measuring out left chain")
                              : FLASH("Measuring out right chain"));
  const float feed = 0.9f * values_.at(kGreatestFeed);
  const bool completed = moveAxis(axis, values_.at(kExtendLength), feed, false);
  axes_.release(axis);
  searchPlace();
  if (!completed) return false;
  out_.fixed(axes_.length(axis), 2).line(FLASH("mm"));
  return true;
}

bool Machine::setChains(float left, float right) {
  if (!isLength(left) || !isLength(right)) return refuseMotion(FLASH("no chain is that long"));
  axes_.declare(kLeftAxis, left);
  axes_.declare(kRightAxis, right);
  out_ << FLASH("Left: ");
  out_.fixed(axes_.length(kLeftAxis), 2).line(FLASH("mm"));
  out_ << FLASH("Right: ");
  out_.fixed(axes_.length(kRightAxis), 2).line(FLASH("mm"));
  keeper_.declareChains();
  findPlace();
  return true;
}

bool Machine::moveChains(const Words& words) {
  const float feed = words.value('F') > 0 ? words.value('F') : kAxisFeed;
  bool completed = true;
  for (uint8_t i = 0; i < 2; ++i) {
    const Axis axis = Axis(i);
    const float given = words.value(axis == kLeftAxis ? 'L' : 'R');
    if (modal_.relative && given == 0) continue;
    const float goal = modal_.relative ? axes_.target(axis) + given : given;
    if (!isLength(goal)) return refuseMotion(FLASH("no chain is that long"));
    completed = completed && moveAxis(axis, goal, feed, false);
  }
  searchPlace();
  return completed;
}

bool Machine::goHome() {
  const motion::Lengths<float> lengths = geometry_.inverse({0, 0});
  if (!lengths.reachable) return refuseMotion(FLASH("with these settings no sled can hang at 0,0"));
  const bool completed = moveAxis(kLeftAxis, lengths.left, kAxisFeed, false) &&
                         moveAxis(kRightAxis, lengths.right, kAxisFeed, false);
  if (completed) findPlace();
  return completed;
}

bool Machine::measureChain(bool left) {
  out_ << FLASH("[Measure: ");
  out_.fixed(axes_.length(left ? kLeftAxis : kRightAxis), 2).line(FLASH("]"));
  return true;
}

bool Machine::simulateMotors(bool on) {
  if (!drain()) return false;
  axes_.releaseAll();
  const bool was_on = axes_.isSimulated();
  if (on && !was_on && !awaitRecord()) return false;
  memory_.setRow(kSimulatedMotors, on);
  axes_.simulate(on);
  out_.line(on ? FLASH("FAKE_SERVO on") : FLASH("FAKE_SERVO off"));
  if (was_on && !on && axes_.isImagined())
    losePosition(FLASH("Motion was simulated, so the chains are elsewhere."));
  return true;
}

}  // namespace machine
