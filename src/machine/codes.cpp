// What each G and M code does. lib/GCode takes the codes that only change how words are read.
#include "machine.h"

namespace machine {

using gcode::Words;

/// A code and the function that does it.
struct Machine::Code {
  char letter;
  uint16_t tenths;
  RunPiece run;
};

bool Machine::find(const gcode::Piece& piece, Code& found) {
  static const Code kCodes[] PROGMEM = {
      {'G', 0, &Machine::beginMotion},
      {'G', 10, &Machine::beginMotion},
      {'G', 20, &Machine::beginMotion},
      {'G', 30, &Machine::beginMotion},
      {'G', 40, &Machine::dwell},
      {'G', 100, &Machine::declare},
      {'G', 280, &Machine::goToKept},
      {'G', 281, &Machine::keepGoal},
      {'G', 300, &Machine::goToKept},
      {'G', 301, &Machine::keepGoal},
      {'G', 382, &Machine::probe},
      {'G', 383, &Machine::probe},
      {'G', 384, &Machine::probe},
      {'G', 385, &Machine::probe},
      {'G', 430, &Machine::forgetToolLength},
      {'G', 431, &Machine::takeToolLength},
      {'G', 490, &Machine::forgetToolLength},
      {'G', 810, &Machine::beginCycle},
      {'G', 820, &Machine::beginCycle},
      {'G', 830, &Machine::beginCycle},
      {'G', 920, &Machine::shift},
      {'G', 921, &Machine::endShift},
      {'G', 922, &Machine::endShift},
      {'G', 923, &Machine::endShift},
      {'M', 0, &Machine::pause},
      {'M', 10, &Machine::pause},
      {'M', 20, &Machine::endProgram},
      {'M', 30, &Machine::startSpindle},
      {'M', 40, &Machine::startSpindle},
      {'M', 50, &Machine::stopSpindle},
      {'M', 60, &Machine::changeTool},
      {'M', 300, &Machine::endProgram},
      {'M', 970, &Machine::refuseSubprogram},
      {'M', 980, &Machine::refuseSubprogram},
      {'M', 990, &Machine::refuseSubprogram},
      {'M', 1060, &Machine::armLaser},
      {'M', 1070, &Machine::armLaser},
  };
  for (uint8_t i = 0; i < sizeof kCodes / sizeof kCodes[0]; ++i) {
    memcpy_P(&found, kCodes + i, sizeof found);
    if (found.letter == piece.letter && found.tenths == piece.tenths) return true;
  }
  return false;
}

bool Machine::knows(const gcode::Piece& piece) {
  Code code;
  return find(piece, code);
}

bool Machine::run(const gcode::Piece& piece) {
  Code code;
  if (find(piece, code)) return (this->*code.run)(piece);
  // Clients freely send M codes of other machines, so an unknown M code is ignored. An unknown G
  // code may have been a motion, so it is refused.
  return piece.letter == 'M' ? ignoreM(piece) : base_.answers.refuseCode(piece);
}

bool Machine::ignoreM(const gcode::Piece& piece) {
  base_.out << FLASH("Command M") << int32_t(piece.tenths / 10);
  if (piece.tenths % 10 != 0) base_.out << '.' << int32_t(piece.tenths % 10);
  base_.out.line(FLASH(" unsupported and ignored."));
  return true;
}

bool Machine::beginMotion(const gcode::Piece& piece) {
  base_.modal.motion = uint8_t(piece.tenths / 10);
  return moves_.move(base_.modal.motion, piece.words);
}

bool Machine::dwell(const gcode::Piece& piece) {
  const Words& words = piece.words;
  if (words.hasPlace()) return base_.answers.refuseWords(FLASH("G4 takes P or S and goes nowhere"));
  // P is in seconds for a sender of Grbl, else in milliseconds.
  const float part = base_.out.speaksGrbl() ? 1 : 0.001f;
  const float seconds =
      float(fabs(words.value('P') != 0 ? words.value('P') * part : words.value('S')));
  if (!(seconds < 86400)) return base_.answers.refuseWords(FLASH("a dwell is shorter than a day"));
  if (!drain()) return false;
  base_.out << FLASH("dwell time ");
  base_.out.fixed(seconds, 3).line(FLASH(" s"));
  return Waiting::dwell(uint32_t(seconds * 1000));
}

bool Machine::declare(const gcode::Piece& piece) {
  const Words& words = piece.words;
  if (words.has('L')) return coordinates_.declare(words);
  if (goesAcross(words)) return base_.answers.refuseWords(FLASH("G10 with X or Y needs L2 or L20"));
  if (!drain()) return false;
  if (!words.has('Z')) return true;
  const float z = base_.modal.toMm(words.value('Z'));
  if (!ZAxis::reaches(z)) return base_.answers.refuseMotion(tooLongForZ());
  z_.declare(z);
  return true;
}

bool Machine::probe(const gcode::Piece& piece) {
  if (goesAcross(piece.words))
    return base_.answers.refuseWords(FLASH("a probe goes along z, and takes no X or Y"));
  const uint8_t kind = uint8_t(piece.tenths - 382);
  if (!single_axis_.probe(moves_.targetOf(piece.words).z, kind < 2, kind % 2 == 0)) return false;
  if (base_.out.speaksGrbl()) sayProbed();
  return true;
}

bool Machine::takeToolLength(const gcode::Piece& piece) {
  return coordinates_.takeToolLength(piece.words);
}

bool Machine::forgetToolLength(const gcode::Piece& piece) {
  // G43 H does the same: there is no table of tools, and z is set for the tool in the spindle.
  coordinates_.forgetToolLength();
  return moveInMode(piece.words);
}

bool Machine::beginCycle(const gcode::Piece& piece) {
  drilling_.begin(uint8_t(piece.tenths / 10));
  return moveInMode(piece.words);
}

bool Machine::endShift(const gcode::Piece& piece) {
  coordinates_.endShift(piece.tenths);
  return moveInMode(piece.words);
}

bool Machine::endProgram(const gcode::Piece&) {
  base_.modal.endProgram();
  if (!drain() || !spindle_.turn(false)) return false;
  base_.cutter.arm(false);
  resetOverrides();
  return true;
}

bool Machine::startSpindle(const gcode::Piece& piece) {
  return drain() && spindle_.takeS(piece.words) && spindle_.turn(true);
}

bool Machine::changeTool(const gcode::Piece& piece) {
  return (!piece.words.has('T') || setTool(piece.words)) && pauses_.changeTool(base_.modal.tool);
}

bool Machine::armLaser(const gcode::Piece& piece) {
  // This counts for moves that are queued from now on; queued moves keep their beam.
  const bool on = piece.tenths == 1060;
  if (on) base_.cutter.setFull();
  if (!spindle_.takeS(piece.words)) return false;
  spindle_.switchLaser(on);
  return true;
}

bool Machine::refuseSubprogram(const gcode::Piece&) {
  return base_.answers.refuseWords(FLASH("subprograms are left to the program that sends"));
}

}  // namespace machine
