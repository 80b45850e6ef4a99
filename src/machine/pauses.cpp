// The program waits. operator_lines.cpp does what the operator may do meanwhile.
#include "pauses.h"

namespace machine {

bool Pauses::pause(bool resumed) {
  out_.line(FLASH("Maslow Paused"));
  interlude_.pause(modal_, waiting_.milliseconds(), input_.isEmpty());
  if (resumed) interlude_.resume();
  // The operator's `~` brings z back and ends the pause.
  const bool completed = waiting_.waitWhile([&] { return interlude_.isPaused(); });
  input_.takeResume();
  return completed;
}

bool Pauses::pauseAfterMoves() {
  // A `~` that comes after this line while earlier moves still run is meant for this pause.
  return waiting_.drain() && pause(input_.takeResume());
}

bool Pauses::changeTool(uint16_t tool) {
  if (tool == modal_.tool_in_spindle) return true;
  if (!waiting_.drain() || !spindle_.turn(false)) return false;
  out_ << FLASH("Tool Change: Please insert tool ") << int32_t(tool);
  out_.end();
  if (!pause(input_.takeResume())) return false;
  modal_.tool_in_spindle = tool;
  return true;
}

bool Pauses::setZByHand(float z) {
  const bool inches = modal_.inches;
  if (!waiting_.drain()) return false;
  const float shown = modal_.fromMm(z);
  out_ << FLASH("Message: Please adjust Z-Axis to a depth of ");
  if (shown > 0) out_ << '+';
  out_.fixed(shown, 2).line(inches ? FLASH(" in") : FLASH(" mm"));
  if (!pause(false)) return false;
  place_.declareZ(z);
  return waiting_.waitFor(1000);
}

}  // namespace machine
