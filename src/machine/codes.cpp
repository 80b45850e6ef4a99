// What each G and M code does. lib/GCode takes the codes that only change how words are read.
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

bool Codes::run(const char* text) {
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

bool Codes::runPiece(const gcode::Piece& piece) {
  const Words& words = piece.words;
  // A hold may have come in a wait that goes on in a hold, as a dwell does.
  base_.waiting.untilRunning();
  // After a stop broke a line off only its modes still count: a stopped jog ends in G90.
  if (base_.waiting.isStopping() || base_.answers.isAnswered())
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
  if (piece.letter == 'G') return runOwn(piece);
  if (piece.letter != 'M') return moveInMode(words);
  // Codes that end or pause a program come after the line's motion, all others before it.
  if (endsLine(piece.tenths)) return moveInMode(words) && runOwn(piece);
  return runOwn(piece) && moveInMode(words);
}

bool Codes::moveInMode(const Words& words) {
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
bool Codes::riseAfterCycle(const Words& words) {
  const Place target = moves_.targetOf(words);
  if (goesAcross(words) || target.z < base_.program.aim().z)
    return base_.answers.refuseWords(FLASH("no motion is in force after G80; say G0 or G1"));
  return moves_.moveStraight(target, false, moves_.feedOf(0));
}

bool Codes::setTool(const Words& words) {
  const float tool = words.value('T');
  if (!(tool >= 0 && tool <= 65535))
    return base_.answers.refuseWords(FLASH("a tool's number is 0 to 65535"));
  base_.modal.tool = uint16_t(tool);
  base_.out << FLASH("Tool change to tool ") << int32_t(base_.modal.tool);
  base_.out.end();
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
  base_.answers.serve(true);
  const gcode::Mistake mistake = gcode::findMistake(text);
  bool is_right = mistake.fault == gcode::Fault::kNone || base_.answers.refuseMistake(mistake);
  gcode::Piece piece;
  Code code;
  for (gcode::Pieces pieces(text); is_right && pieces.next(piece);)
    if (piece.letter == 'G' && !base_.modal.take(piece.tenths) && !find(piece, code))
      is_right = base_.answers.refuseCode(piece);
  base_.answers.serve(false);
  return is_right;
}

bool Codes::runOwn(const gcode::Piece& piece) {
  Code code;
  if (find(piece, code)) return (this->*code.run)(piece);
  // Clients freely send M codes of other machines, so an unknown M code is ignored. An unknown G
  // code may have been a motion, so it is refused.
  return piece.letter == 'M' ? ignoreM(piece) : base_.answers.refuseCode(piece);
}

bool Codes::ignoreM(const gcode::Piece& piece) {
  base_.out << FLASH("Command M") << int32_t(piece.tenths / 10);
  if (piece.tenths % 10 != 0) base_.out << '.' << int32_t(piece.tenths % 10);
  base_.out.line(FLASH(" unsupported and ignored."));
  return true;
}

bool Codes::beginMotion(const gcode::Piece& piece) {
  base_.modal.motion = uint8_t(piece.tenths / 10);
  return moves_.move(base_.modal.motion, piece.words);
}

bool Codes::dwell(const gcode::Piece& piece) {
  const Words& words = piece.words;
  if (words.hasPlace()) return base_.answers.refuseWords(FLASH("G4 takes P or S and goes nowhere"));
  // P is in seconds for a sender of Grbl, else in milliseconds.
  const float part = base_.out.speaksGrbl() ? 1 : 0.001f;
  const float seconds =
      float(fabs(words.value('P') != 0 ? words.value('P') * part : words.value('S')));
  if (!(seconds < 86400)) return base_.answers.refuseWords(FLASH("a dwell is shorter than a day"));
  if (!base_.waiting.drain()) return false;
  base_.out << FLASH("dwell time ");
  base_.out.fixed(seconds, 3).line(FLASH(" s"));
  return base_.waiting.dwell(uint32_t(seconds * 1000));
}

bool Codes::declare(const gcode::Piece& piece) {
  const Words& words = piece.words;
  if (words.has('L')) return coordinates_.declare(words);
  if (goesAcross(words)) return base_.answers.refuseWords(FLASH("G10 with X or Y needs L2 or L20"));
  if (!base_.waiting.drain()) return false;
  if (!words.has('Z')) return true;
  const float z = base_.modal.toMm(words.value('Z'));
  if (!ZAxis::reaches(z)) return base_.answers.refuseMotion(tooLongForZ());
  z_.declare(z);
  return true;
}

bool Codes::probe(const gcode::Piece& piece) {
  if (goesAcross(piece.words))
    return base_.answers.refuseWords(FLASH("a probe goes along z, and takes no X or Y"));
  const uint8_t kind = uint8_t(piece.tenths - 382);
  if (!single_axis_.probe(moves_.targetOf(piece.words).z, kind < 2, kind % 2 == 0)) return false;
  if (base_.out.speaksGrbl()) single_axis_.sayProbed();
  return true;
}

bool Codes::forgetToolLength(const gcode::Piece& piece) {
  // G43 H does the same: there is no table of tools, and z is set for the tool in the spindle.
  coordinates_.forgetToolLength();
  return moveInMode(piece.words);
}

bool Codes::beginCycle(const gcode::Piece& piece) {
  drilling_.begin(uint8_t(piece.tenths / 10));
  return moveInMode(piece.words);
}

bool Codes::endShift(const gcode::Piece& piece) {
  coordinates_.endShift(piece.tenths);
  return moveInMode(piece.words);
}

bool Codes::endProgram(const gcode::Piece&) {
  base_.modal.endProgram();
  if (!base_.waiting.drain() || !spindle_.turn(false)) return false;
  base_.cutter.arm(false);
  overrides_.reset();
  return true;
}

bool Codes::startSpindle(const gcode::Piece& piece) {
  return base_.waiting.drain() && spindle_.takeS(piece.words) && spindle_.turn(true);
}

bool Codes::changeTool(const gcode::Piece& piece) {
  return (!piece.words.has('T') || setTool(piece.words)) && pauses_.changeTool(base_.modal.tool);
}

bool Codes::armLaser(const gcode::Piece& piece) {
  // This counts for moves that are queued from now on; queued moves keep their beam.
  const bool on = piece.tenths == 1060;
  if (on) base_.cutter.setFull();
  if (!spindle_.takeS(piece.words)) return false;
  spindle_.switchLaser(on);
  return true;
}

bool Codes::refuseSubprogram(const gcode::Piece&) {
  return base_.answers.refuseWords(FLASH("subprograms are left to the program that sends"));
}

}  // namespace machine
