// The program waits. operator_lines.cpp does what the operator may do meanwhile.
#include "parts.h"

namespace machine {

bool Pauses::pause() {
  parts_.out.line(FLASH("Maslow Paused"));
  parts_.operator_lines.pause();
  // The operator's `~` brings z back and ends the pause.
  return parts_.waiting.untilRunning();
}

bool Pauses::pauseAfterMoves() {
  if (!parts_.waiting.drain() || !parts_.waiting.untilRunning()) return false;
  // A `~` that came after this line while earlier moves still ran is meant for this pause.
  if (!parts_.input.takeResume()) return pause();
  parts_.out.line(FLASH("Maslow Paused"));
  return true;
}

bool Pauses::changeTool(uint16_t tool) {
  if (tool == parts_.modal.tool_in_spindle) return true;
  if (!parts_.waiting.drain() || !parts_.spindle.turn(false) || !parts_.waiting.untilRunning())
    return false;
  parts_.out << FLASH("Tool Change: Please insert tool ") << int32_t(tool);
  parts_.out.end();
  if (!pause()) return false;
  parts_.modal.tool_in_spindle = tool;
  return true;
}

bool Pauses::setZByHand(float z, bool into_work) {
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

}  // namespace machine
