// The program waits. operator_lines.cpp does what the operator may do meanwhile.
#include "pauses.h"

namespace machine {

bool Pauses::pause() {
  base_.out.line(FLASH("Maslow Paused"));
  operator_lines_.pause();
  // The operator's `~` brings z back and ends the pause.
  return base_.waiting.untilRunning();
}

bool Pauses::pauseAfterMoves() {
  if (!base_.waiting.drain() || !base_.waiting.untilRunning()) return false;
  // A `~` that came after this line while earlier moves still ran is meant for this pause.
  if (!base_.input.takeResume()) return pause();
  base_.out.line(FLASH("Maslow Paused"));
  return true;
}

bool Pauses::changeTool(uint16_t tool) {
  if (tool == base_.modal.tool_in_spindle) return true;
  if (!base_.waiting.drain() || !spindle_.turn(false) || !base_.waiting.untilRunning())
    return false;
  base_.out << FLASH("Tool Change: Please insert tool ") << int32_t(tool);
  base_.out.end();
  if (!pause()) return false;
  base_.modal.tool_in_spindle = tool;
  return true;
}

bool Pauses::setZByHand(float z, bool into_work) {
  const bool inches = base_.modal.inches;
  if (!base_.waiting.drain()) return false;
  const bool stands_meanwhile = spindle_.isOn() && !into_work;
  if ((stands_meanwhile && !spindle_.turn(false)) || !base_.waiting.untilRunning()) return false;
  const float shown = base_.modal.fromMm(z);
  base_.out << FLASH("Message: Please adjust Z-Axis to a depth of ");
  if (shown > 0) base_.out << '+';
  base_.out.fixed(shown, 2).line(inches ? FLASH(" in") : FLASH(" mm"));
  if (!pause()) return false;
  place_.declareZ(z);
  return stands_meanwhile ? spindle_.turn(true) : base_.waiting.waitFor(1000);
}

}  // namespace machine
