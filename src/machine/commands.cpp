// Executes a line: cuts it in front of each G and M, runs the pieces from left to right, answers.
#include "b_lines.h"
#include "machine.h"

namespace machine {
namespace {

using gcode::Words;

/// The letter of a word for an axis that only other machines have; 0 if there is none.
char foreignAxis(const Words& words) {
  for (const char* letter = "ABCUVW"; *letter != '\0'; ++letter)
    if (words.has(*letter)) return *letter;
  return gcode::kNoLetter;
}

/// The letter of a coordinate that no machine reaches; 0 if there is none.
char farAxis(const gcode::Modal& modal, const Words& words) {
  for (uint8_t axis = 0; axis < kPlaceAxes; ++axis) {
    const float most = axis == kZAxis ? kMostZ : kMostTravel;
    if (!(float(fabs(modal.toMm(words.value(kAxisLetters[axis])))) <= most))
      return kAxisLetters[axis];
  }
  return gcode::kNoLetter;
}

/// M0, M1, M2 and M30.
bool endsLine(uint16_t tenths) { return tenths <= 20 || tenths == 300; }

}  // namespace

void Machine::loop() {
  service();
  if (isStopping()) return finishStop();
  if (base_.course.is(State::kJogging) && !isMoving()) base_.course.take(Event::kStood);
  char line[gcode::Input::kRoom + 1];
  // A program waits here while its moves are made: nothing of a line stands on the stack.
  if (base_.course.isWaiting() || !base_.planner.hasRoom() || !base_.input.takeLine(line))
    return base_.clock.sleep();
  base_.answers.begin(line);
  if (isDroppedJog(line)) return answer(true);
  is_executing_ = *line != '$';
  const bool done = execute(line);
  // The clients' Hold and Pause only stop sending. The queue is short enough that the sled then
  // stops soon.
  waitWhile(
      [&] { return !base_.answers.isAnswered() && (base_.course.isWaiting() || isFarAhead()); });
  is_executing_ = false;
  answer(done);
}

void Machine::answer(bool done) {
  if (base_.answers.mustHalt()) halt();
  // A line that a stop or an alarm broke off gets no answer.
  if (done && !isStopping() && !base_.answers.isAnswered()) base_.out.plain(FLASH("ok"));
}

void Machine::halt() {
  if (!untilRunning()) return;
  base_.course.take(Event::kHalt);
  forgetUnanswered();
  // Moves that were queued before are good: let them end first.
  if (drain()) spindle_.turn(false);
}

bool Machine::execute(char* line) {
  if (base_.input.wasTooLong()) {
    if (isHalted()) return refuseNow(kCode);
    base_.answers.begin("");
    return base_.answers.refuseWords(tooLongALine());
  }
  char* first = line;
  while (*first == ' ') ++first;
  if (isOfMaslow(first)) speakMaslow();
  const bool is_b = *first == 'b' || *first == 'B';
  if (is_b && mayRun(kindOf(first))) {
    // The first words of GroundControl, WebControl and the lab.
    if (bCodeOf(first) == 5) speakMaslow();
    echo(first);
  }
  gcode::clean(line);
  if (*line == '\0') return true;
  if (!mayRun(kindOf(line))) return refuseNow(kindOf(line));
  if (is_b) return runB(line);
  if (*line == '$') return base_.out.speaksGrbl() ? runGrbl(line) : runSetting(line);
  return base_.course.is(State::kChecking) ? checkCode(line) : runCode(line);
}

/// The gate of every line.
bool Machine::mayRun(Kind kind) const {
  // A jog begins, and so does the check, where nothing is on its way.
  const bool needs_rest = (kind == kJog || kind == kCheck) && base_.course.isRunning();
  return base_.course.allows(kind) && !(needs_rest && isMoving());
}

/// A line comes after an alarm: only a sender of Grbl counts on an answer.
bool Machine::refuseNow(Kind kind) {
  if (isHalted() && !base_.out.speaksGrbl()) return false;
  const bool is_line_of_dollar = kind != kCode && kind != kAct;
  return base_.answers.refuseBare(is_line_of_dollar ? grbl::kNotIdle : grbl::kLocked);
}

void Machine::echo(const char* line) {
  uint8_t length = 0;
  for (uint8_t i = 0; line[i] != '\0'; ++i)
    if (line[i] != ' ') length = uint8_t(i + 1);
  for (uint8_t i = 0; i < length; ++i)
    base_.out << (line[i] >= 'a' && line[i] <= 'z' ? char(line[i] - 'a' + 'A') : line[i]);
  base_.out.end();
}

bool Machine::runCode(const char* text) {
  const gcode::Mistake mistake = gcode::findMistake(text);
  if (mistake.fault != gcode::Fault::kNone) return base_.answers.refuseMistake(mistake);
  new_values_.refreshBeforeLine();
  base_.modal.beginLine();
  gcode::Pieces pieces(text);
  gcode::Piece piece;
  bool going = true;
  while (pieces.next(piece)) going = runPiece(piece) && going;
  return going;
}

bool Machine::runPiece(const gcode::Piece& piece) {
  const Words& words = piece.words;
  // A hold may have come in a wait that goes on in a hold, as a dwell does.
  untilRunning();
  // After a stop broke a line off only its modes still count: a stopped jog ends in G90.
  if (isStopping() || base_.answers.isAnswered())
    return piece.letter == 'G' && base_.modal.take(piece.tenths);
  if (const char axis = foreignAxis(words))
    return base_.answers.refuseWords(FLASH("there is no axis "), axis);
  if (piece.letter != 'M' && words.has('T') && !setTool(words)) return false;
  // S of a G4 are seconds.
  if (piece.letter != 'M' && !(piece.letter == 'G' && piece.tenths == 40) && !spindle_.takeS(words))
    return false;
  const bool was_relative = base_.modal.relative;
  const bool is_mode = piece.letter == 'G' && base_.modal.take(piece.tenths);
  if (const char axis = farAxis(base_.modal, words))
    return base_.answers.refuseMotion(FLASH("that is farther than any machine reaches: "), axis);
  if (is_mode) {
    // A jog begins where the sled is, even at the sheet's edge.
    if (base_.modal.relative && !was_relative) base_.program.countFromAim();
    return moveInMode(words);
  }
  if (piece.letter == 'G') return run(piece);
  if (piece.letter != 'M') return moveInMode(words);
  // Codes that end or pause a program come after the line's motion, all others before it.
  if (endsLine(piece.tenths)) return moveInMode(words) && run(piece);
  return run(piece) && moveInMode(words);
}

bool Machine::moveInMode(const Words& words) {
  moves_.takeFeed(words);
  const uint8_t mode = base_.modal.motion;
  const bool is_arc = mode == 2 || mode == 3;
  const bool turns =
      is_arc && (words.has('I') || words.has('J') || words.has('K') || words.has('R'));
  if (!words.hasPlace() && !turns) return true;
  if (mode == gcode::kNoMotion) return riseAfterCycle(words);
  return mode > gcode::kNoMotion ? drilling_.drill(words) : moves_.move(mode, words);
}

/// After G80 no motion is in force. Programs go on with z alone to lift the bit, and that is safe
/// whichever motion they mean.
bool Machine::riseAfterCycle(const Words& words) {
  const Place target = moves_.targetOf(words);
  if (goesAcross(words) || target.z < base_.program.aim().z)
    return base_.answers.refuseWords(FLASH("no motion is in force after G80; say G0 or G1"));
  return moves_.moveStraight(target, false, moves_.feedOf(0));
}

bool Machine::setTool(const Words& words) {
  const float tool = words.value('T');
  if (!(tool >= 0 && tool <= 65535))
    return base_.answers.refuseWords(FLASH("a tool's number is 0 to 65535"));
  base_.modal.tool = uint16_t(tool);
  base_.out << FLASH("Tool change to tool ") << int32_t(base_.modal.tool);
  base_.out.end();
  return true;
}

bool Machine::runQuestion(const char* line) {
  if (*line == 'B') return runB(line);
  settings_lines_.dump();
  return true;
}

bool Machine::runSetting(const char* line) {
  const char* const text = line + 1;
  // Some senders of Grbl begin with these, and no client of Maslow's does.
  if ((*text == 'I' || *text == 'G') && text[1] == '\0') {
    is_sure_ = true;
    base_.out.speak(Dialect::kGrbl);
    return runGrbl(line);
  }
  if (*text == '\0') {
    base_.out.line(
        FLASH("$$ shows all settings, $n=value sets one, $RST=$ or # or * restores defaults"));
    return true;
  }
  if (!drain()) return false;
  if (*text == '$') {
    if (text[1] != '\0') return base_.answers.refuseStatement();
    settings_lines_.dump();
    return true;
  }
  if (text[0] == '#' && text[1] == '\0') {
    coordinates_.show();
    return true;
  }
  if (strncmp_P(text, PSTR("RST="), 4) == 0) return runReset(text + 4);
  return settings_lines_.set(text);
}

bool Machine::runReset(const char* what) {
  using settings::Reset;
  const bool is_known = (what[0] == '$' || what[0] == '#' || what[0] == '*') && what[1] == '\0';
  if (!is_known) return base_.answers.refuseStatement();
  if (what[0] == '#' && base_.out.speaksGrbl()) {
    coordinates_.forget();
    return true;
  }
  restoreDefaults(what[0] == '$'   ? Reset::kSettings
                  : what[0] == '#' ? Reset::kSettingsAndPosition
                                   : Reset::kEverything);
  return true;
}

void Machine::restoreDefaults(settings::Reset what) {
  base_.out.line(FLASH("Message: Restoring defaults "));
  spindle_.switchLaser(false);
  base_.memory.reset(what);
  const bool forgets_position = what != settings::Reset::kSettings;
  if (forgets_position) {
    base_.axes.setCounts(0, 0, 0);
    base_.keeper.startAfresh();
  }
  base_.axes.simulate(base_.values.at(kSimulatedMotors) != 0);
  new_values_.take(NewValues::kAll);
  greeting_.sayBoard();
  greeting_.sayMotors(base_.axes.isSimulated());
  greeting_.sayReady();
  base_.answers.setAnswered(true);
  if (!forgets_position) return;
  new_values_.prepareGeometry();
  place_.search(Search::kErased);
  place_.sayUnset(true);
}

}  // namespace machine
