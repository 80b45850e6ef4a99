// What the machine says first: its board, its name, that it is ready.
#include "machine.h"

namespace machine {

void Machine::greet(bool after_power_on) {
  if (board_.driver_name == nullptr) {
    out << FLASH("ALARM: The Board version number from this Motor Control board is invalid. ");
    out.line(FLASH("No motor will be driven; see the wiring page for straps."));
  } else {
    out << FLASH("PCB v1.") << int32_t(board_.version) << board_.driver_name;
    out.line(FLASH(" Detected"));
  }
  // Clients show these lines and look for none of them, but other programs wait for "Grbl".
  if (after_power_on) out.line(axes.isSimulated() ? FLASH("FAKE_SERVO on") : FLASH("FAKE_SERVO off"));
  out.line(FLASH("Grbl v1.00"));
  out.line(FLASH("Plumb " PLUMB_VERSION ", firmware for the Maslow CNC"));
  out.line(FLASH("ready"));
}

}  // namespace machine
