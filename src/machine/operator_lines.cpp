// Holds, pauses, lines of the operator, and z on its way back.
#include "b_lines.h"
#include "parts.h"

namespace machine {

using gcode::Words;

OperatorLines::OperatorLines(Parts& parts) : parts_(parts), coming_(&parts.input) {}

bool OperatorLines::isOperatorsTurn() const { return parts_.course.lines() == Lines::kOperator; }

void OperatorLines::wait(Event event) {
  if (parts_.course.isRunning()) program_ = parts_.modal;
  const bool was_turn = isOperatorsTurn();
  if (parts_.course.take(event) && !was_turn) since_ms_ = parts_.clock.milliseconds();
}

bool OperatorLines::pause() {
  parts_.out.line(FLASH("Maslow Paused"));
  wait(Event::kPause);
  // The operator's `~` brings z back and ends the pause.
  return parts_.waiting.untilRunning();
}

bool OperatorLines::pauseAfterMoves() {
  if (!parts_.waiting.drain() || !parts_.waiting.untilRunning()) return false;
  // A `~` that came after this line while earlier moves still ran is meant for this pause.
  if (!parts_.input.takeResume()) return pause();
  parts_.out.line(FLASH("Maslow Paused"));
  return true;
}

bool OperatorLines::changeTool(uint16_t tool) {
  if (tool == parts_.modal.tool_in_spindle) return true;
  if (!parts_.waiting.drain() || !parts_.spindle.turn(false) || !parts_.waiting.untilRunning())
    return false;
  parts_.out << FLASH("Tool Change: Please insert tool ") << int32_t(tool);
  parts_.out.end();
  if (!pause()) return false;
  parts_.modal.tool_in_spindle = tool;
  return true;
}

bool OperatorLines::setZByHand(float z, bool into_work) {
  const bool inches = parts_.modal.inches;
  if (!parts_.waiting.drain()) return false;
  const bool stands_meanwhile = parts_.cutter.isSpindleOn() && !into_work;
  if ((stands_meanwhile && !parts_.spindle.turn(false)) || !parts_.waiting.untilRunning())
    return false;
  const float shown = parts_.modal.fromMm(z);
  parts_.out << FLASH("Message: Please adjust Z-Axis to a depth of ");
  if (shown > 0) parts_.out << '+';
  parts_.out.fixed(shown, 2).line(inches ? FLASH(" in") : FLASH(" mm"));
  if (!pause()) return false;
  parts_.place.declareZ(z);
  return stands_meanwhile ? parts_.spindle.turn(true) : parts_.waiting.waitFor(1000);
}

void OperatorLines::resume() {
  const uint32_t now = parts_.clock.milliseconds();
  // A `~` that ends this wait does not answer a later pause. Grbl senders may send it at any time.
  if (!parts_.course.isRunning() || now - resumed_ms_ < kTwice || parts_.out.speaksGrbl())
    parts_.input.takeResume();
  resumed_ms_ = now;
  parts_.course.take(Event::kResume);
}

gcode::Input& OperatorLines::inputFor(char character) {
  const uint32_t kFirstMs = 300;  // a sender that has not noticed may go on for a moment
  if (character != '\n' && !coming_->isInLine()) {
    // For a Grbl sender a line sent in a hold belongs to the program and runs after the hold.
    const bool is_own = !parts_.out.speaksGrbl() && isOperatorsTurn() &&
                        parts_.clock.milliseconds() - since_ms_ >= kFirstMs;
    coming_ = is_own ? &typed_ : &parts_.input;
  }
  return *coming_;
}

void OperatorLines::serve() {
  if (parts_.answers.isServing()) return;
  if (parts_.course.isComingBack()) comeBack();
  if (!isOperatorsTurn() || parts_.axes.isPathAtRest()) serveLine();
}

void OperatorLines::comeBack() {
  if (!parts_.axes.isLifted()) {
    parts_.modal = program_;
    parts_.course.take(Event::kBack);
    return;
  }
  if (!parts_.course.take(Event::kLower)) return;
  parts_.out << FLASH("Z goes back to ");
  parts_.out.fixed(parts_.modal.fromMm(parts_.axes.plannedZ()), 2).end();
  // While the motors rested G10 may have said where z is. A hold may come while they wake.
  if ((parts_.axes.isPowered() || parts_.motors.wake()) && parts_.course.is(State::kLowering))
    parts_.axes.lower(parts_.z.mostFeed() / 60, parts_.z.acceleration());
}

void OperatorLines::serveLine() {
  char line[gcode::Input::kRoom + 1];
  if (!typed_.takeLine(line)) return;
  gcode::clean(line);
  // A line of the program that waits keeps its answer, or lack of it, whatever this line gets.
  const bool is_other_answered = parts_.answers.isAnswered();
  parts_.answers.setAnswered(false);
  parts_.answers.serve(true);
  const bool done = runOrRefuse(line);
  parts_.answers.serve(false);
  parts_.waiting.answer(done);
  parts_.answers.setAnswered(is_other_answered);
}

bool OperatorLines::runOrRefuse(const char* line) {
  if (stale_ != 0) {
    --stale_;
    return parts_.answers.refuse(FLASH("a hold came after this line; send it again"));
  }
  if (!isOperatorsTurn())
    return parts_.answers.refuse(FLASH("the program went on before this line; send it again"));
  if (typed_.wasTooLong()) return parts_.answers.refuse(tooLongALine());
  if (isForOperator(line)) return run(line);
  return parts_.answers.refuse(
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
      return words.has('Z') && parts_.z.hasMotor();
    case 100:
      return words.has('Z') && !words.has('L') &&
             ZAxis::reaches(parts_.modal.toMm(words.value('Z')));
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
    parts_.out << line;
    parts_.out.end();
  }
  if (line[0] == 'B' || line[0] == '$') return parts_.waiting.runQuestion(line);
  gcode::Piece piece;
  for (gcode::Pieces pieces(line); pieces.next(piece);) {
    if (piece.tenths == 100)
      parts_.z.declareInHold(parts_.modal.toMm(piece.words.value('Z')));
    else if (!parts_.modal.take(piece.tenths) && !jogZ(piece.words))
      return false;
  }
  return true;
}

bool OperatorLines::jogZ(const Words& words) {
  const float target = parts_.z.within(parts_.modal.targetOf(
      parts_.axes.liftedTo(), words.value('Z'), parts_.coordinates.begin(kZAxis)));
  if (!ZAxis::reaches(target)) return parts_.answers.refuse(tooLongForZ());
  if (!parts_.motors.doesZFollow() || (!parts_.axes.isPowered() && !parts_.motors.wake()))
    return false;
  const float most = parts_.z.mostFeed();
  const float asked = words.has('F') ? parts_.modal.toMm(words.value('F')) : most;
  parts_.axes.lift(target, (asked < most ? asked : most) / 60, parts_.z.acceleration());
  return true;
}

}  // namespace machine
