// Lines of the operator, and z on its way back.
#include "operator_lines.h"

#include "b_lines.h"

namespace machine {

using gcode::Words;

void OperatorLines::hold() {
  interlude_.hold(modal_, clock_.milliseconds(), input_.isEmpty());
  axes_.hold(true);
}

void OperatorLines::resume() {
  if (!interlude_.isOn()) return;
  // That `~` was for this hold, not for an M0 that waits.
  input_.takeResume();
  interlude_.resume();
}

void OperatorLines::serve() {
  if (!interlude_.isOn()) return;
  if (interlude_.isEnding()) {
    // Z may be about to rise, as soon as its motor has power.
    if (interlude_.isServing() || !bringZBack()) return;
    modal_ = interlude_.modal();
    interlude_.end();
    axes_.hold(false);
    return;
  }
  if (interlude_.takesLines(clock_.milliseconds(), input_.isEmpty()) && axes_.isAtRest())
    serveLine();
}

bool OperatorLines::bringZBack() {
  if (!axes_.isLifted()) return true;
  if (interlude_.beginsLowering()) {
    out_ << FLASH("Z goes back to ");
    out_.fixed(modal_.fromMm(axes_.plannedZ()), 2).end();
    // While the motors rested G10 may have said where z is.
    interlude_.serve(true);
    const bool has_power = motors_.areOn() || motors_.wake();
    interlude_.serve(false);
    if (has_power) axes_.lower(z_.mostFeed() / 60, z_.acceleration());
  }
  return false;
}

void OperatorLines::serveLine() {
  char line[gcode::Input::kRoom + 1];
  if (!input_.peekLine(line)) return;
  gcode::clean(line);
  if (!isForOperator(line)) return;
  // A line of the program that waits keeps its answer, or lack of it, whatever this line gets.
  const bool is_other_answered = answers_.isAnswered();
  answers_.setAnswered(false);
  interlude_.serve(true);
  answers_.serve(true);
  input_.dropLine();
  const bool done = run(line);
  interlude_.serve(false);
  answers_.serve(false);
  dispatch_.answer(done);
  answers_.setAnswered(is_other_answered);
}

bool OperatorLines::isForOperator(const char* line) const {
  if (line[0] == 'B') return isQuestion(bCodeOf(line)) || isZLimitCode(bCodeOf(line));
  if (line[0] == '$') return line[1] == '$' && line[2] == '\0';
  if (gcode::findMistake(line).fault != gcode::Fault::kNone) return false;
  gcode::Piece piece;
  for (gcode::Pieces pieces(line); pieces.next(piece);)
    if (!isForOperator(piece)) return false;
  return true;
}

bool OperatorLines::isForOperator(const gcode::Piece& piece) const {
  const Words& words = piece.words;
  const bool crosses = goesAcross(words) || words.has('I') || words.has('J');
  if (piece.letter != 'G' || crosses) return false;
  switch (piece.tenths) {
    case 0:
    case 10:
      return words.has('Z') && z_.hasMotor();
    case 100:
      return words.has('Z') && !words.has('L') &&
             float(fabs(modal_.toMm(words.value('Z')))) <= kMostTravel;
    case 200:
    case 210:
    case 900:
    case 910:
      return !words.has('Z');
    default:
      return false;
  }
}

bool OperatorLines::run(const char* line) {
  if (line[0] == 'B') {
    out_ << line;
    out_.end();
  }
  if (line[0] == 'B' || line[0] == '$') return dispatch_.runQuestion(line);
  gcode::Piece piece;
  for (gcode::Pieces pieces(line); pieces.next(piece);) {
    if (piece.tenths == 100)
      z_.declareInHold(modal_.toMm(piece.words.value('Z')));
    else if (!modal_.take(piece.tenths) && !jogZ(piece.words))
      return false;
  }
  return true;
}

bool OperatorLines::jogZ(const Words& words) {
  const float target =
      z_.within(modal_.targetOf(axes_.liftedTo(), words.value('Z'), coordinates_.begin(kZAxis)));
  if (!(float(fabs(target)) <= kMostTravel)) return answers_.refuse(tooLongForZ());
  if (!motors_.areOn() && !motors_.wake()) return false;
  const float most = z_.mostFeed();
  const float asked = words.has('F') ? modal_.toMm(words.value('F')) : most;
  axes_.lift(target, (asked < most ? asked : most) / 60, z_.acceleration());
  return true;
}

}  // namespace machine
