// While the program waits: the operator's lines, and the way back.
#include "machine.h"

namespace machine {

void Machine::holdMotion() {
  if (stopping_ || isHalted()) return;
  interlude_.hold(modal_, clock_.milliseconds(), input_.isEmpty());
  axes_.hold(true);
}

void Machine::resumeInterlude() {
  if (!interlude_.isOn()) return;
  // It was meant for this, not for an M0 that waits.
  input_.takeResume();
  interlude_.resume();
}

void Machine::serveInterlude() {
  if (!interlude_.isOn() || stopping_) return;
  if (interlude_.isEnding()) {
    if (!bringZBack()) return;
    modal_ = interlude_.modal();
    interlude_.end();
    axes_.hold(false);
    return;
  }
  if (axes_.isAtRest() && interlude_.takesLines(clock_.milliseconds(), input_.isEmpty()))
    serveOperator();
}

bool Machine::bringZBack() {
  if (!axes_.isLifted()) return true;
  if (interlude_.beginsLowering()) {
    out_ << FLASH("Z goes back to ");
    out_.fixed(inUnits(axes_.plannedZ()), 2).end();
    axes_.lower();
  }
  return false;
}

void Machine::serveOperator() {
  char line[Input::kRoom + 1];
  if (!input_.peekLine(line)) return;
  gcode::clean(line);
  if (!isForOperator(line)) return;
  const bool is_other_answered = is_answered_;
  is_answered_ = false;
  interlude_.serve(true);
  input_.dropLine();
  const bool done = runForOperator(line);
  interlude_.serve(false);
  if (done && !is_answered_) out_.line(FLASH("ok"));
  is_answered_ = is_other_answered;
}

bool Machine::isForOperator(const char* line) const {
  if (line[0] == 'B') return isQuestion(line) || isZLimitCode(line);
  if (line[0] == '$') return line[1] == '$' && line[2] == '\0';
  if (gcode::findMistake(line).fault != gcode::Fault::kNone) return false;
  gcode::Piece piece;
  for (gcode::Pieces pieces(line); pieces.next(piece);)
    if (!isForOperator(piece)) return false;
  return true;
}

bool Machine::isForOperator(const gcode::Piece& piece) const {
  const Words& words = piece.words;
  const bool crosses = words.has('X') || words.has('Y') || words.has('I') || words.has('J');
  if (piece.letter != 'G' || crosses) return false;
  switch (piece.tenths) {
    case 0:
    case 10:
      return words.has('Z') && values_.at(kZMotor) != 0;
    case 100:
      return words.has('Z') && !words.has('L') &&
             float(fabs(fromUnits(words.value('Z')))) <= kMostTravel;
    case 200:
    case 210:
    case 900:
    case 910:
      return !words.has('Z');
    default:
      return false;
  }
}

bool Machine::runForOperator(const char* line) {
  if (line[0] == 'B') {
    out_ << line;
    out_.end();
    return runB(line);
  }
  if (line[0] == '$') {
    dumpSettings();
    return true;
  }
  gcode::Piece piece;
  for (gcode::Pieces pieces(line); pieces.next(piece);) {
    if (piece.tenths == 100)
      declareZInInterlude(fromUnits(piece.words.value('Z')));
    else if (!modal_.take(piece.tenths) && !jogZ(piece.words))
      return false;
  }
  return true;
}

bool Machine::jogZ(const Words& words) {
  const float target = withinZLimits(
      modal_.targetOf(axes_.liftedTo(), words.value('Z'), offsets_.at(modal_.system, kZAxis)));
  if (!(float(fabs(target)) <= kMostTravel)) return refuse(FLASH("no z axis is that long"));
  if (!axes_.isPowered() && !wakeMotors()) return false;
  const float asked = words.has('F') ? fromUnits(words.value('F')) : mostZFeed();
  const float feed = asked < mostZFeed() ? asked : mostZFeed();
  axes_.lift(target, feed / 60, values_.at(kAccelerationZ));
  return true;
}

void Machine::declareZInInterlude(float z) {
  const float shift = z - axes_.length(kZAxis);
  axes_.declareLifted(z);
  shiftZLimits(shift);
  keeper_.declareZ();
}

void Machine::changeFeed(Quick quick) {
  if (!feed_.take(quick)) return;
  axes_.goAt(uint16_t(feed_.shareOfPlan() * float(motion::Playback::kAllOfIt)));
  mover_.boost(feed_.boost());
  out_ << FLASH("[Feed: ") << int32_t(feed_.percent());
  out_.line(FLASH(" %]"));
}

}  // namespace machine
