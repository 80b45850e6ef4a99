// What each G code does. Codes that only change how words are read are known to lib/GCode.
#include "machine.h"

namespace machine {

bool Machine::runG(const gcode::Piece& piece) {
  struct Code {
    uint16_t tenths;
    bool (Machine::*run)(const gcode::Piece& piece);
  };
  static const Code kCodes[] PROGMEM = {
      {0, &Machine::beginMotion},      {10, &Machine::beginMotion},
      {20, &Machine::beginMotion},     {30, &Machine::beginMotion},
      {40, &Machine::dwell},           {100, &Machine::declareByWords},
      {280, &Machine::goToKept},       {281, &Machine::keepGoal},
      {300, &Machine::goToKept},       {301, &Machine::keepGoal},
      {382, &Machine::probeDown},      {430, &Machine::forgetToolLength},
      {431, &Machine::takeToolLength}, {490, &Machine::forgetToolLength},
      {810, &Machine::beginCycle},     {820, &Machine::beginCycle},
      {830, &Machine::beginCycle},     {920, &Machine::shiftCoordinates},
      {921, &Machine::endShift},       {922, &Machine::endShift},
      {923, &Machine::endShift},
  };
  if (modal_.take(piece.tenths)) return moveInMode(piece.words);
  for (uint8_t i = 0; i < sizeof kCodes / sizeof kCodes[0]; ++i) {
    Code code;
    memcpy_P(&code, kCodes + i, sizeof code);
    if (code.tenths == piece.tenths) return (this->*code.run)(piece);
  }
  return refuseCode(piece);
}

bool Machine::beginMotion(const gcode::Piece& piece) {
  modal_.motion = uint8_t(piece.tenths / 10);
  return move(modal_.motion, piece.words);
}

bool Machine::moveInMode(const Words& words) {
  takeFeed(words);
  const uint8_t mode = modal_.motion;
  const bool is_arc = mode == 2 || mode == 3;
  const bool turns = is_arc && (words.has('I') || words.has('J') || words.has('R'));
  if (!words.hasPlace() && !turns) return true;
  if (mode == gcode::kNoMotion)
    return refuseMotion(FLASH("no motion is in force after G80; say G0 or G1"));
  return mode > gcode::kNoMotion ? drill(words) : move(mode, words);
}

bool Machine::dwell(const gcode::Piece& piece) {
  const Words& words = piece.words;
  const float seconds =
      float(fabs(words.value('P') != 0 ? words.value('P') / 1000 : words.value('S')));
  if (!(seconds < 86400)) return refuseMotion(FLASH("a dwell is shorter than a day"));
  if (!drain()) return false;
  out_ << FLASH("dwell time ");
  out_.fixed(seconds, 3).line(FLASH(" s"));
  return waitFor(uint32_t(seconds * 1000));
}

bool Machine::probeDown(const gcode::Piece& piece) { return probe(targetOf(piece.words).z); }

}  // namespace machine
