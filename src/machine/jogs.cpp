// `$J=`: moves by hand from a sender of Grbl, and how 0x85 ends them.
#include "machine.h"

namespace machine {

using gcode::Words;

bool Machine::jog(const char* text) {
  base_.course.take(Event::kJog);
  const gcode::Modal program = base_.modal;
  // Nothing of a program depends on a jog, so no refusal halts the machine.
  base_.answers.serve(true);
  const bool done = queueJog(text);
  base_.answers.serve(false);
  base_.modal = program;
  if (base_.answers.isAnswered()) return done;
  // At once, for a sender waits with its next jog; and also where 0x85 ended the wait for room.
  base_.out.plain(FLASH("ok"));
  base_.answers.setAnswered(true);
  return done;
}

bool Machine::queueJog(const char* text) {
  const gcode::Mistake mistake = gcode::findMistake(text);
  if (mistake.fault != gcode::Fault::kNone) return base_.answers.refuseMistake(mistake);
  new_values_.refreshBeforeLine();
  Words words;
  base_.modal.beginLine();
  base_.modal.motion = 0;
  if (!readJog(text, words)) return false;
  if (!words.has('F')) return base_.answers.refuse(FLASH("a jog needs F"), grbl::kNoFeed);
  if (words.has('Z') && !z_.hasMotor())
    return base_.answers.refuse(FLASH("z has no motor ($16)"), grbl::kBadJog);
  // A jog begins where the sled is, even at the sheet's edge.
  base_.program.countFromAim();
  const float kLeastFeed = 1;  // [mm/min]
  const float most = moves_.feedOf(0), asked = base_.modal.toMm(words.value('F'));
  const float feed = !(asked > kLeastFeed) ? kLeastFeed : asked < most ? asked : most;
  return moves_.moveStraight(moves_.targetOf(words), goesAcross(words), feed);
}

/// Takes a jog's codes into the modes, and its words; false, with a refusal, where it has others.
bool Machine::readJog(const char* text, Words& words) {
  gcode::Piece piece;
  for (gcode::Pieces pieces(text); pieces.next(piece);) {
    const bool is_mode = piece.tenths == 200 || piece.tenths == 210 || piece.tenths == 530 ||
                         piece.tenths == 900 || piece.tenths == 910;
    if (piece.letter != gcode::kNoLetter && !(piece.letter == 'G' && is_mode))
      return base_.answers.refuse(FLASH("a jog takes G20, G21, G53, G90 and G91 only"),
                                  grbl::kBadJog);
    if (piece.letter == 'G') base_.modal.take(piece.tenths);
    for (const char* letter = "XYZF"; *letter != '\0'; ++letter)
      if (piece.words.has(*letter)) words.add(*letter, piece.words.value(*letter));
  }
  return words.hasPlace() || base_.answers.refuse(FLASH("a jog needs X, Y or Z"), grbl::kBadJog);
}

void Machine::endJog() {
  // A sender may have sent more of them than there is room for.
  if (base_.course.take(Event::kEndJog)) dropped_jogs_ = base_.input.lines();
}

bool Machine::isDroppedJog(const char* line) {
  if (dropped_jogs_ == 0) return false;
  --dropped_jogs_;
  return strncmp_P(line, PSTR("$J="), 3) == 0;
}

}  // namespace machine
