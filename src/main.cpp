// Connects the machine with its board. It makes no decisions.
#include <Arduino.h>

#include "board/aux_pins.h"
#include "board/control_clock.h"
#include "board/eeprom.h"
#include "board/motors.h"
#include "board/serial_line.h"
#include "board/shield.h"
#include "board/stack_guard.h"
#include "board/watchdog.h"
#include "machine/machine.h"
#include "settings_flash.h"

namespace {

board::SerialLine line;
board::Motors motors;
board::AuxPins aux_pins;
board::ControlClock control_clock;
board::Eeprom eeprom;
FlashTable settings_table;
machine::Machine* maslow;

void tick() { maslow->tick(); }

/// The main program hangs: nothing may keep turning.
void letGo() {
  motors.releaseAll();
  maslow->noteHang();
}

machine::BoardName nameOf(const board::Shield* shield) {
  const machine::Start start = board::watchdog::start();
  if (!shield) return {0, nullptr, start};
  return {shield->version, board::nameOf(shield->driver), start};
}

}  // namespace

void setup() {
  board::stack_guard::paint();
  line.begin();
  const board::Shield* const shield = board::detectShield();
  motors.begin(shield);
  aux_pins.begin(shield);
  static machine::Machine machine({line, motors, aux_pins, control_clock, eeprom, settings_table},
                                  nameOf(shield));
  maslow = &machine;
  machine.begin();
  control_clock.begin(tick, letGo, machine.ticksPerSecond());
}

void loop() { maslow->loop(); }
