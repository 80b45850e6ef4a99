// Moves of one axis alone, in its own length: calibration moves and the probe.
#include "machine.h"

namespace machine {

bool Machine::moveAxis(Axis axis, float goal, float feed, bool until_probe) {
  if (!drain() || !wakeMotors()) return false;
  mover_.standAt(axes_.setPoint());
  mover_.addAxis(axis, goal, feed / 60);
  bool touched = false;
  while (isMoving() && !touched && !isHalted()) {
    touched = until_probe && aux_.probeTouches();
    serveAndSleep();
  }
  const float touched_at = axes_.length(axis);
  if (touched) {
    mover_.forget();
    axes_.dropSetPoints();
  }
  settle();
  // The axis ran on for a moment.
  if (touched) axes_.declare(axis, axes_.length(axis) - touched_at);
  mover_.standAt(axes_.setPoint());
  return !stopping_ && (touched || !until_probe);
}

}  // namespace machine
