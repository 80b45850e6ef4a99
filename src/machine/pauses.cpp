// The program waits. operator_lines.cpp does what the operator may do meanwhile.
#include "pauses.h"

namespace machine {

bool Pauses::pause() {
  out_.line(FLASH("Maslow Paused"));
  operator_lines_.pause();
  // The operator's `~` brings z back and ends the pause.
  return waiting_.untilRunning();
}

bool Pauses::pauseAfterMoves() {
  if (!waiting_.drain() || !waiting_.untilRunning()) return false;
  // A `~` that came after this line while earlier moves still ran is meant for this pause.
  if (!input_.takeResume()) return pause();
  out_.line(FLASH("Maslow Paused"));
  return true;
}

bool Pauses::changeTool(uint16_t tool) {
  if (tool == modal_.tool_in_spindle) return true;
  if (!waiting_.drain() || !spindle_.turn(false) || !waiting_.untilRunning()) return false;
  out_ << FLASH("Tool Change: Please insert tool ") << int32_t(tool);
  out_.end();
  if (!pause()) return false;
  modal_.tool_in_spindle = tool;
  return true;
}

bool Pauses::setZByHand(float z, bool into_work) {
  const bool inches = modal_.inches;
  if (!waiting_.drain()) return false;
  const bool stands_meanwhile = spindle_.isOn() && !into_work;
  if ((stands_meanwhile && !spindle_.turn(false)) || !waiting_.untilRunning()) return false;
  const float shown = modal_.fromMm(z);
  out_ << FLASH("Message: Please adjust Z-Axis to a depth of ");
  if (shown > 0) out_ << '+';
  out_.fixed(shown, 2).line(inches ? FLASH(" in") : FLASH(" mm"));
  if (!pause()) return false;
  place_.declareZ(z);
  return stands_meanwhile ? spindle_.turn(true) : waiting_.waitFor(1000);
}

}  // namespace machine
