// The Mega's 4 KB of EEPROM.
#pragma once

#include <Settings.h>

namespace board {

/// Reads and writes a byte at a time. A write goes on for 3.4 ms after write() returns.
class Eeprom : public settings::Bytes {
 public:
  uint16_t size() const override;
  bool ready() const override;
  uint8_t read(uint16_t address) const override;
  void write(uint16_t address, uint8_t value) override;
};

}  // namespace board
