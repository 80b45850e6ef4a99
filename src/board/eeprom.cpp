// The EEPROM by its registers: avr-libc's functions would wait while a write goes on.
#include "eeprom.h"

#include <avr/io.h>
#include <util/atomic.h>

namespace board {

uint16_t Eeprom::size() const { return E2END + 1; }

bool Eeprom::ready() const { return !(EECR & (1 << EEPE)); }

uint8_t Eeprom::read(uint16_t address) const {
  EEAR = address;
  EECR |= 1 << EERE;
  return EEDR;
}

void Eeprom::write(uint16_t address, uint8_t value) {
  EEAR = address;
  EEDR = value;
  EECR = 0;
  // The second bit must follow the first within four cycles.
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
    EECR |= 1 << EEMPE;
    EECR |= 1 << EEPE;
  }
}

}  // namespace board
