// What happens while anything waits: characters come in, quick ones act at once, set-points go out,
// faults are noticed, reports are sent.
#include "machine.h"

namespace machine {

void Machine::service() {
  readWire();
  mover.fill(axes, geometry);
  watchAxes();
  refreshGeometryWhenQuiet();
  restWhenIdle();
  memory.step();
  reportWhenDue();
  clock.idle();
}

bool Machine::waitFor(uint32_t ms) {
  const uint32_t start = clock.milliseconds();
  while (!stopping_ && clock.milliseconds() - start < ms) service();
  return !stopping_;
}

bool Machine::drain() {
  while (!stopping_ && isMoving()) service();
  return !stopping_;
}

void Machine::stopNow() {
  stopping_ = true;
  pausing_ = resumed_ = expects_resume_ = false;
  input.clear();
  // At once, whatever else the stop has to wait for.
  aux.set(Output::kLaser, false);
  restSpindle();
  mover.stop();
  if (halt_ == Halt::kAlarm) halt_ = Halt::kNone;
}

void Machine::finishStop() {
  while (isMoving()) service();
  axes.stopOpenDrives();
  // A new stop may come meanwhile; it is answered, and this one goes on.
  stopping_ = false;
  switchSpindle(false);
  out.line(FLASH("Laser off"));
  if (is_chains_known_) findPlace();
  if (resetting_) keepPosition();
  resetting_ = false;
}

void Machine::resetSoftly() {
  resetting_ = true;
  out.end();
  out.line(FLASH("soft reset commanded"));
  greet(false);
}

void Machine::raiseAlarm(FlashText text) {
  if (halt_ == Halt::kAlarm) return;
  stopNow();
  halt_ = Halt::kAlarm;
  axes.halt();
  mover.forget();
  out << FLASH("ALARM: ");
  out.line(text);
}

void Machine::watchAxes() {
  if (uint8_t(wire.lost()) != 0)
    raiseAlarm(FLASH("Characters were lost on the serial line; the job is stopped. Press Stop."));
  switch (axes.trouble()) {
    case Trouble::kNone:
      return;
    default:
      break;
  }
  raiseAlarm(
      FLASH("The sled is not keeping up with its expected position and has halted. Press Stop, "
            "check chains, motors and encoder cables, then set the chain lengths if they slipped."));
}

}  // namespace machine
