// Pauses: M0, tool changes, the z axis that is set by hand; all wait for `~`.
#include "machine.h"

namespace machine {

bool Machine::pause() {
  out_.line(FLASH("Maslow Paused"));
  pausing_ = true;
  while (!stopping_ && !resumed_) service();
  pausing_ = resumed_ = false;
  return !stopping_;
}

bool Machine::pauseAfterMoves() {
  // A `~` that comes while the pause still waits for earlier moves is meant for it.
  resumed_ = false;
  expects_resume_ = true;
  const bool drained = drain();
  expects_resume_ = false;
  return drained && pause();
}

bool Machine::changeTool(uint16_t tool) {
  if (tool == modal_.tool_in_spindle) return true;
  resumed_ = false;
  expects_resume_ = true;
  const bool ready = drain() && switchSpindle(false);
  expects_resume_ = false;
  if (!ready) return false;
  out_ << FLASH("Tool Change: Please insert tool ") << int32_t(tool);
  out_.end();
  modal_.tool_in_spindle = tool;
  return pause();
}

bool Machine::setZByHand(float z) {
  const bool inches = modal_.inches;
  if (!drain()) return false;
  const float shown = inches ? z / 25.4f : z;
  out_ << FLASH("Message: Please adjust Z-Axis to a depth of ");
  if (shown > 0) out_ << '+';
  out_.fixed(shown, 2).line(inches ? FLASH(" in") : FLASH(" mm"));
  if (!pause()) return false;
  axes_.declare(kZAxis, z);
  aim_.z = z;
  mover_.standAt(axes_.setPoint());
  return waitFor(1000);
}

}  // namespace machine
