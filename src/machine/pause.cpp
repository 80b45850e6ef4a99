// Pauses: M0, tool changes, the z axis that is set by hand; all wait for `~`.
#include "machine.h"

namespace machine {

bool Machine::pause(bool resumed) {
  out_.line(FLASH("Maslow Paused"));
  interlude_.pause(modal_, clock_.milliseconds(), input_.isEmpty());
  if (resumed) interlude_.resume();
  // serveInterlude() brings z back and ends it.
  while (!stopping_ && interlude_.isPaused()) serveAndSleep();
  input_.takeResume();
  return !stopping_;
}

bool Machine::pauseAfterMoves() {
  // A `~` that comes behind this line while earlier moves still run is meant for it.
  return drain() && pause(input_.takeResume());
}

bool Machine::changeTool(uint16_t tool) {
  if (tool == modal_.tool_in_spindle) return true;
  if (!drain() || !switchSpindle(false)) return false;
  out_ << FLASH("Tool Change: Please insert tool ") << int32_t(tool);
  out_.end();
  modal_.tool_in_spindle = tool;
  return pause(input_.takeResume());
}

bool Machine::setZByHand(float z) {
  const bool inches = modal_.inches;
  if (!drain()) return false;
  const float shown = inches ? z / 25.4f : z;
  out_ << FLASH("Message: Please adjust Z-Axis to a depth of ");
  if (shown > 0) out_ << '+';
  out_.fixed(shown, 2).line(inches ? FLASH(" in") : FLASH(" mm"));
  if (!pause(false)) return false;
  axes_.declare(kZAxis, z);
  aim_.z = z;
  mover_.standAt(axes_.setPoint());
  keeper_.declareZ();
  return waitFor(1000);
}

}  // namespace machine
