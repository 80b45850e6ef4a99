// Lines of the operator, and z on its way back.
#include "operator_lines.h"

#include "b_lines.h"

namespace machine {

using gcode::Words;

void OperatorLines::wait(Event event) {
  if (base_.course.isRunning()) program_ = base_.modal;
  const bool was_turn = isOperatorsTurn();
  if (base_.course.take(event) && !was_turn) since_ms_ = base_.clock.milliseconds();
}

void OperatorLines::resume() {
  const uint32_t now = base_.clock.milliseconds();
  // A `~` that ends a wait is no answer to a pause to come.
  // Senders of Grbl press it at any time.
  if (!base_.course.isRunning() || now - resumed_ms_ < kTwice || base_.out.speaksGrbl())
    base_.input.takeResume();
  resumed_ms_ = now;
  base_.course.take(Event::kResume);
}

gcode::Input& OperatorLines::inputFor(char character) {
  const uint32_t kFirstMs = 300;  // a sender that has not noticed may go on for a moment
  if (character != '\n' && !coming_->isInLine()) {
    // To a sender of Grbl a line in a hold is one of the program, to be done after it.
    const bool is_own = !base_.out.speaksGrbl() && isOperatorsTurn() &&
                        base_.clock.milliseconds() - since_ms_ >= kFirstMs;
    coming_ = is_own ? &typed_ : &base_.input;
  }
  return *coming_;
}

void OperatorLines::serve() {
  if (base_.answers.isServing()) return;
  if (base_.course.isComingBack()) comeBack();
  if (!isOperatorsTurn() || base_.axes.isPathAtRest()) serveLine();
}

void OperatorLines::comeBack() {
  if (!base_.axes.isLifted()) {
    base_.modal = program_;
    base_.course.take(Event::kBack);
    return;
  }
  if (!base_.course.take(Event::kLower)) return;
  base_.out << FLASH("Z goes back to ");
  base_.out.fixed(base_.modal.fromMm(base_.axes.plannedZ()), 2).end();
  // While the motors rested G10 may have said where z is. A hold may come while they wake.
  if ((motors_.areOn() || motors_.wake()) && base_.course.is(State::kLowering))
    base_.axes.lower(z_.mostFeed() / 60, z_.acceleration());
}

void OperatorLines::serveLine() {
  char line[gcode::Input::kRoom + 1];
  if (!typed_.takeLine(line)) return;
  gcode::clean(line);
  // A line of the program that waits keeps its answer, or lack of it, whatever this line gets.
  const bool is_other_answered = base_.answers.isAnswered();
  base_.answers.setAnswered(false);
  base_.answers.serve(true);
  const bool done = runOrRefuse(line);
  base_.answers.serve(false);
  dispatch_.answer(done);
  base_.answers.setAnswered(is_other_answered);
}

bool OperatorLines::runOrRefuse(const char* line) {
  if (stale_ != 0) {
    --stale_;
    return base_.answers.refuse(FLASH("a hold came after this line; send it again"));
  }
  if (!isOperatorsTurn())
    return base_.answers.refuse(FLASH("the program went on before this line; send it again"));
  if (typed_.wasTooLong()) return base_.answers.refuse(tooLongALine());
  if (isForOperator(line)) return run(line);
  return base_.answers.refuse(
      FLASH("the program waits: answer it with ~ or !; until then only z, its zero and questions"));
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
             ZAxis::reaches(base_.modal.toMm(words.value('Z')));
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
    base_.out << line;
    base_.out.end();
  }
  if (line[0] == 'B' || line[0] == '$') return dispatch_.runQuestion(line);
  gcode::Piece piece;
  for (gcode::Pieces pieces(line); pieces.next(piece);) {
    if (piece.tenths == 100)
      z_.declareInHold(base_.modal.toMm(piece.words.value('Z')));
    else if (!base_.modal.take(piece.tenths) && !jogZ(piece.words))
      return false;
  }
  return true;
}

bool OperatorLines::jogZ(const Words& words) {
  const float target = z_.within(
      base_.modal.targetOf(base_.axes.liftedTo(), words.value('Z'), coordinates_.begin(kZAxis)));
  if (!ZAxis::reaches(target)) return base_.answers.refuse(tooLongForZ());
  if (!door_.doesZFollow() || (!motors_.areOn() && !motors_.wake())) return false;
  const float most = z_.mostFeed();
  const float asked = words.has('F') ? base_.modal.toMm(words.value('F')) : most;
  base_.axes.lift(target, (asked < most ? asked : most) / 60, z_.acceleration());
  return true;
}

}  // namespace machine
