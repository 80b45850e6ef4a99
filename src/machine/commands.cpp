// A line becomes commands: cut in front of each G and M, run from left to right.
#include "machine.h"

namespace machine {
namespace {

bool isSetting(char first) { return first == '$'; }

/// An axis that other machines have, if there is a word for it; 0 if not.
char foreignAxis(const Words& words) {
  for (const char* letter = "ABCUVW"; *letter != '\0'; ++letter)
    if (words.has(*letter)) return *letter;
  return gcode::kNoLetter;
}

/// M0, M1, M2 and M30.
bool endsLine(uint16_t tenths) { return tenths <= 20 || tenths == 300; }

}  // namespace

void Machine::loop() {
  service();
  if (stopping_) {
    finishStop();
    return;
  }
  char line[Input::kRoom + 1];
  if (!input_.takeLine(line)) {
    clock_.sleep();
    return;
  }
  is_answered_ = false;
  const bool done = execute(line);
  // A sender that sends no more, as the clients' Hold and Pause do, soon stops the sled.
  while (!stopping_ && !is_answered_ && isFarAhead()) serveAndSleep();
  // What a stop or an alarm broke off is owed no answer.
  if (stopping_ || is_answered_) return;
  if (done) out_.line(FLASH("ok"));
}

bool Machine::execute(char* line) {
  line_ = line;
  if (input_.wasTooLong()) {
    if (isHalted()) return false;
    line[0] = '\0';
    return refuseMotion(FLASH("a line of more than 126 characters, which was skipped"));
  }
  char* first = line;
  while (*first == ' ') ++first;
  if (*first == 'b' || *first == 'B') {
    if (isHalted() && !isQuestion(first)) return false;
    echo(first);
    gcode::clean(line);
    return runB(line);
  }
  gcode::clean(line);
  if (*line == '\0') return true;
  if (isSetting(*line)) return runSetting(line);
  return !isHalted() && runCode(line);
}

void Machine::echo(const char* line) {
  uint8_t length = 0;
  for (uint8_t i = 0; line[i] != '\0'; ++i)
    if (line[i] != ' ') length = uint8_t(i + 1);
  for (uint8_t i = 0; i < length; ++i)
    out_ << (line[i] >= 'a' && line[i] <= 'z' ? char(line[i] - 'a' + 'A') : line[i]);
  out_.end();
}

bool Machine::runCode(const char* text) {
  const gcode::Mistake mistake = gcode::findMistake(text);
  if (mistake.fault != gcode::Fault::kNone) return refuseMistake(mistake);
  modal_.beginLine();
  gcode::Pieces pieces(text);
  gcode::Piece piece;
  bool going = true;
  while (pieces.next(piece)) going = runPiece(piece) && going;
  return going;
}

bool Machine::runPiece(const gcode::Piece& piece) {
  const Words& words = piece.words;
  // Of a line that a stop broke off only its modes still count: a stopped jog ends in G90.
  if (stopping_ || is_answered_) return piece.letter == 'G' && modal_.take(piece.tenths);
  if (const char axis = foreignAxis(words)) return refuseMotion(FLASH("there is no axis "), axis);
  if (piece.letter != 'M' && words.has('T') && !setTool(words)) return false;
  // S of a G4 are seconds.
  if (piece.letter != 'M' && !(piece.letter == 'G' && piece.tenths == 40) && !takeS(words))
    return false;
  if (piece.letter == 'G') return runG(piece);
  if (piece.letter != 'M') return moveInMode(words);
  // What ends or pauses a program comes after the line's motion, all else before it.
  if (endsLine(piece.tenths)) return moveInMode(words) && runM(piece.tenths, words);
  return runM(piece.tenths, words) && moveInMode(words);
}

bool Machine::ignoreM(uint16_t tenths) {
  out_ << FLASH("Command M") << int32_t(tenths / 10);
  if (tenths % 10 != 0) out_ << '.' << int32_t(tenths % 10);
  out_.line(FLASH(" unsupported and ignored."));
  return true;
}

bool Machine::runM(uint16_t tenths, const Words& words) {
  // Everything but moves waits until the moves before it are over.
  switch (tenths) {
    case 0:
    case 10:
      return pauseAfterMoves();
    case 20:
    case 300:
      modal_.endProgram();
      if (!drain() || !switchSpindle(false)) return false;
      cutter_.arm(false);
      changeFeed(Quick::kFeedUsual);
      return true;
    case 50:
      return drain() && switchSpindle(false);
    case 30:
    case 40:
      return drain() && takeS(words) && switchSpindle(true);
    case 60:
      return (!words.has('T') || setTool(words)) && changeTool(modal_.tool);
    case 1060:
    case 1070:
      // With the moves, not at once: what is queued keeps what it was queued with.
      if (tenths == 1060) cutter_.setFull();
      if (!takeS(words)) return false;
      switchLaser(tenths == 1060);
      return true;
    case 970:
    case 980:
    case 990:
      return refuseMotion(FLASH("subprograms are left to the program that sends"));
    default:
      return ignoreM(tenths);
  }
}

bool Machine::setTool(const Words& words) {
  const float tool = words.value('T');
  if (!(tool >= 0 && tool <= 65535)) return refuseMotion(FLASH("a tool's number is 0 to 65535"));
  modal_.tool = uint16_t(tool);
  out_ << FLASH("Tool change to tool ") << int32_t(modal_.tool);
  out_.end();
  return true;
}

bool Machine::declareZByWord(const Words& words) {
  if (!drain()) return false;
  if (!words.has('Z')) return true;
  const float z = fromUnits(words.value('Z'));
  if (!(float(fabs(z)) <= kMostTravel)) return refuseMotion(FLASH("no z axis is that long"));
  declareZ(z);
  return true;
}

}  // namespace machine
