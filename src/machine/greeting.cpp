// The messages of a start.
#include "greeting.h"

#include "version.h"

namespace machine {

void Greeting::sayBoard() {
  if (board_.driver == nullptr) {
    out_.alarm(1) << FLASH("The Board version number from this Motor Control board is invalid. ");
    out_.line(FLASH("No motor will be driven; see the wiring page for its straps."));
    return;
  }
  out_ << FLASH("PCB v1.") << int32_t(board_.version) << board_.driver;
  out_.line(FLASH(" Detected"));
}

void Greeting::sayReady() {
  out_.line(FLASH("Plumb v" PLUMB_VERSION ", firmware for the Maslow CNC"));
  // The client is not known yet, and some Grbl senders wait for this line before they send.
  sayWelcome();
  out_.line(FLASH("ready"));
  out_.plain(FLASH("ok"));
}

void Greeting::sayWelcome() { out_.plain(FLASH("Grbl 1.1h ['$' for help]")); }

void Greeting::sayMotors(bool are_simulated) {
  out_.line(are_simulated ? FLASH("FAKE_SERVO on") : FLASH("FAKE_SERVO off"));
}

void Greeting::sayStart() {
  if (board_.start == Start::kBrownOut)
    out_.line(FLASH("The 5 V of the Mega broke down and it started again: check its supply."));
  if (board_.start == Start::kWatchdog)
    out_.line(FLASH("The firmware hung and the watchdog started it again, with motors off."));
}

void Greeting::saySource(const settings::Started& started) {
  using settings::Source;
  switch (started.source) {
    case Source::kStored:
      return;
    case Source::kStoredInPart:
      return out_.error(0).line(
          FLASH("Some settings were out of today's limits and have defaults."));
    case Source::kImported:
      return out_.line(FLASH("Settings of the published firmware were taken over."));
    case Source::kDefaults:
      // On a fresh board sayUnset() says it.
      if (started.known == settings::Known::kNothing) return;
      return out_.error(0).line(FLASH("EEPROM read fail. Using default settings."));
    case Source::kOtherVersion:
      out_.error(0) << FLASH("Settings of another firmware, version ") << int32_t(started.version);
      return out_.line(FLASH(", are not read. Using default settings."));
    case Source::kBadValue:
      out_.error(0) << FLASH("The published firmware's $") << int32_t(started.number);
      return out_.line(FLASH(" cannot be right; none was taken over. Using default settings."));
  }
}

}  // namespace machine
