// Actions of the G and M codes. lib/GCode takes the codes that only change how words are read.
#include "codes.h"

namespace machine {
namespace {

using gcode::Words;

/// The letter of a word for an axis that only other machines have; 0 if there is none.
char foreignAxis(const Words& words) {
  for (const char* letter = "ABCUVW"; *letter != '\0'; ++letter)
    if (words.has(*letter)) return *letter;
  return gcode::kNoLetter;
}

/// The letter of a coordinate beyond any machine's reach; 0 if there is none.
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

bool Codes::run(const char* text) {
  const gcode::Mistake mistake = gcode::findMistake(text);
  if (mistake.fault != gcode::Fault::kNone) return parts_.answers.refuseMistake(mistake);
  parts_.new_values.refreshBeforeLine();
  parts_.modal.beginLine();
  gcode::Pieces pieces(text);
  gcode::Piece piece;
  bool going = true;
  while (pieces.next(piece)) going = runPiece(piece) && going;
  return going;
}

bool Codes::runPiece(const gcode::Piece& piece) {
  const Words& words = piece.words;
  // A hold may have come during a wait that goes on in a hold, such as a dwell.
  parts_.waiting.untilRunning();
  // After a stop broke a line off only its modes still count: a stopped jog ends in G90.
  if (parts_.waiting.isStopping() || parts_.answers.isAnswered())
    return piece.letter == 'G' && parts_.modal.take(piece.tenths);
  if (const char axis = foreignAxis(words))
    return parts_.answers.refuseWords(FLASH("there is no axis "), axis);
  if (piece.letter != 'M' && words.has('T') && !setTool(words)) return false;
  // S of a G4 are seconds.
  if (piece.letter != 'M' && !(piece.letter == 'G' && piece.tenths == 40) &&
      !parts_.spindle.takeS(words))
    return false;
  const bool was_relative = parts_.modal.relative;
  const bool is_mode = piece.letter == 'G' && parts_.modal.take(piece.tenths);
  if (const char axis = farAxis(parts_.modal, words))
    return parts_.answers.refuseMotion(FLASH("that is farther than any machine reaches: "), axis);
  if (is_mode) {
    // A jog begins where the sled is, even at the sheet's edge.
    if (parts_.modal.relative && !was_relative) parts_.program.countFromAim();
    return moveInMode(words);
  }
  if (piece.letter == 'G') return runOwn(piece);
  if (piece.letter != 'M') return moveInMode(words);
  // Codes that end or pause a program come after the line's motion, all others before it.
  if (endsLine(piece.tenths)) return moveInMode(words) && runOwn(piece);
  return runOwn(piece) && moveInMode(words);
}

bool Codes::moveInMode(const Words& words) {
  parts_.moves.takeFeed(words);
  const uint8_t mode = parts_.modal.motion;
  const bool is_arc = mode == 2 || mode == 3;
  const bool turns =
      is_arc && (words.has('I') || words.has('J') || words.has('K') || words.has('R'));
  if (!words.hasPlace() && !turns) return true;
  if (mode == gcode::kNoMotion) return riseAfterCycle(words);
  return mode > gcode::kNoMotion ? parts_.drilling.drill(words) : parts_.moves.move(mode, words);
}

/// After G80 no motion is in force. Programs go on with z alone to lift the bit, and that is safe
/// whatever the motion was.
bool Codes::riseAfterCycle(const Words& words) {
  const Place target = parts_.moves.targetOf(words);
  if (goesAcross(words) || target.z < parts_.program.aim().z)
    return parts_.answers.refuseWords(FLASH("no motion is in force after G80; say G0 or G1"));
  return parts_.moves.moveStraight(target, false, parts_.moves.feedOf(0));
}

bool Codes::setTool(const Words& words) {
  const float tool = words.value('T');
  if (!(tool >= 0 && tool <= 65535))
    return parts_.answers.refuseWords(FLASH("a tool's number is 0 to 65535"));
  parts_.modal.tool = uint16_t(tool);
  parts_.out << FLASH("Tool change to tool ") << int32_t(parts_.modal.tool);
  parts_.out.end();
  return true;
}

/// A code and the function that does it.
struct Codes::Code {
  char letter;
  uint16_t tenths;
  Run run;
};

bool Codes::find(const gcode::Piece& piece, Code& found) {
  static const Code kCodes[] PROGMEM = {
      {'G', 0, &Codes::beginMotion},
      {'G', 10, &Codes::beginMotion},
      {'G', 20, &Codes::beginMotion},
      {'G', 30, &Codes::beginMotion},
      {'G', 40, &Codes::dwell},
      {'G', 100, &Codes::declare},
      {'G', 280, &Codes::goToKept},
      {'G', 281, &Codes::keepGoal},
      {'G', 300, &Codes::goToKept},
      {'G', 301, &Codes::keepGoal},
      {'G', 382, &Codes::probe},
      {'G', 383, &Codes::probe},
      {'G', 384, &Codes::probe},
      {'G', 385, &Codes::probe},
      {'G', 430, &Codes::forgetToolLength},
      {'G', 431, &Codes::takeToolLength},
      {'G', 490, &Codes::forgetToolLength},
      {'G', 810, &Codes::beginCycle},
      {'G', 820, &Codes::beginCycle},
      {'G', 830, &Codes::beginCycle},
      {'G', 920, &Codes::shift},
      {'G', 921, &Codes::endShift},
      {'G', 922, &Codes::endShift},
      {'G', 923, &Codes::endShift},
      {'M', 0, &Codes::pause},
      {'M', 10, &Codes::pause},
      {'M', 20, &Codes::endProgram},
      {'M', 30, &Codes::startSpindle},
      {'M', 40, &Codes::startSpindle},
      {'M', 50, &Codes::stopSpindle},
      {'M', 60, &Codes::changeTool},
      {'M', 300, &Codes::endProgram},
      {'M', 970, &Codes::refuseSubprogram},
      {'M', 980, &Codes::refuseSubprogram},
      {'M', 990, &Codes::refuseSubprogram},
      {'M', 1060, &Codes::armLaser},
      {'M', 1070, &Codes::armLaser},
  };
  for (uint8_t i = 0; i < sizeof kCodes / sizeof kCodes[0]; ++i) {
    memcpy_P(&found, kCodes + i, sizeof found);
    if (found.letter == piece.letter && found.tenths == piece.tenths) return true;
  }
  return false;
}

bool Codes::check(const char* text) {
  parts_.answers.serve(true);
  const gcode::Mistake mistake = gcode::findMistake(text);
  bool is_right = mistake.fault == gcode::Fault::kNone || parts_.answers.refuseMistake(mistake);
  gcode::Piece piece;
  Code code;
  for (gcode::Pieces pieces(text); is_right && pieces.next(piece);)
    if (piece.letter == 'G' && !parts_.modal.take(piece.tenths) && !find(piece, code))
      is_right = parts_.answers.refuseCode(piece);
  parts_.answers.serve(false);
  return is_right;
}

bool Codes::runOwn(const gcode::Piece& piece) {
  Code code;
  if (find(piece, code)) return (this->*code.run)(piece);
  // Clients freely send M codes of other machines, so an unknown M code is ignored. An unknown G
  // code may have been a motion, so it is refused.
  return piece.letter == 'M' ? ignoreM(piece) : parts_.answers.refuseCode(piece);
}

bool Codes::ignoreM(const gcode::Piece& piece) {
  parts_.out << FLASH("Command M") << int32_t(piece.tenths / 10);
  if (piece.tenths % 10 != 0) parts_.out << '.' << int32_t(piece.tenths % 10);
  parts_.out.line(FLASH(" unsupported and ignored."));
  return true;
}

bool Codes::beginMotion(const gcode::Piece& piece) {
  parts_.modal.motion = uint8_t(piece.tenths / 10);
  return parts_.moves.move(parts_.modal.motion, piece.words);
}

bool Codes::dwell(const gcode::Piece& piece) {
  const Words& words = piece.words;
  if (words.hasPlace())
    return parts_.answers.refuseWords(FLASH("G4 takes P or S and goes nowhere"));
  // P is in seconds for a Grbl sender, else in milliseconds.
  const float part = parts_.out.speaksGrbl() ? 1 : 0.001f;
  const float seconds =
      float(fabs(words.value('P') != 0 ? words.value('P') * part : words.value('S')));
  if (!(seconds < 86400)) return parts_.answers.refuseWords(FLASH("a dwell is shorter than a day"));
  if (!parts_.waiting.drain()) return false;
  parts_.out << FLASH("dwell time ");
  parts_.out.fixed(seconds, 3).line(FLASH(" s"));
  return parts_.waiting.dwell(uint32_t(seconds * 1000));
}

bool Codes::declare(const gcode::Piece& piece) {
  const Words& words = piece.words;
  if (words.has('L')) return parts_.coordinates.declare(words);
  if (goesAcross(words))
    return parts_.answers.refuseWords(FLASH("G10 with X or Y needs L2 or L20"));
  if (!parts_.waiting.drain()) return false;
  if (!words.has('Z')) return true;
  const float z = parts_.modal.toMm(words.value('Z'));
  if (!ZAxis::reaches(z)) return parts_.answers.refuseMotion(tooLongForZ());
  parts_.z.declare(z);
  return true;
}

bool Codes::probe(const gcode::Piece& piece) {
  if (goesAcross(piece.words))
    return parts_.answers.refuseWords(FLASH("a probe goes along z, and takes no X or Y"));
  const uint8_t kind = uint8_t(piece.tenths - 382);
  if (!parts_.single_axis.probe(parts_.moves.targetOf(piece.words).z, kind < 2, kind % 2 == 0))
    return false;
  if (parts_.out.speaksGrbl()) parts_.single_axis.sayProbed();
  return true;
}

bool Codes::forgetToolLength(const gcode::Piece& piece) {
  // G43 H does the same: there is no table of tools, and z is set for the tool in the spindle.
  parts_.coordinates.forgetToolLength();
  return moveInMode(piece.words);
}

bool Codes::beginCycle(const gcode::Piece& piece) {
  parts_.drilling.begin(uint8_t(piece.tenths / 10));
  return moveInMode(piece.words);
}

bool Codes::endShift(const gcode::Piece& piece) {
  parts_.coordinates.endShift(piece.tenths);
  return moveInMode(piece.words);
}

bool Codes::endProgram(const gcode::Piece&) {
  parts_.modal.endProgram();
  if (!parts_.waiting.drain() || !parts_.spindle.turn(false)) return false;
  parts_.cutter.arm(false);
  parts_.overrides.reset();
  return true;
}

bool Codes::startSpindle(const gcode::Piece& piece) {
  return parts_.waiting.drain() && parts_.spindle.takeS(piece.words) && parts_.spindle.turn(true);
}

bool Codes::changeTool(const gcode::Piece& piece) {
  return (!piece.words.has('T') || setTool(piece.words)) &&
         parts_.operator_lines.changeTool(parts_.modal.tool);
}

bool Codes::armLaser(const gcode::Piece& piece) {
  // This counts for moves that are queued from now on; queued moves keep their beam.
  const bool on = piece.tenths == 1060;
  if (on) parts_.cutter.setFull();
  if (!parts_.spindle.takeS(piece.words)) return false;
  parts_.spindle.switchLaser(on);
  return true;
}

bool Codes::refuseSubprogram(const gcode::Piece&) {
  return parts_.answers.refuseWords(FLASH("subprograms are left to the program that sends"));
}

}  // namespace machine
