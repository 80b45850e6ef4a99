// Memory that keeps its bytes without power, one byte at a time, as the laws see it.
#pragma once

#include <stdint.h>

namespace settings {

/// What the EEPROM can do. A write takes 3.4 ms there; it goes on while the caller runs.
class Bytes {
 public:
  /// Number of bytes; addresses run from 0.
  virtual uint16_t size() const = 0;
  /// False while a write is still going on: neither read nor write then.
  virtual bool ready() const = 0;
  virtual uint8_t read(uint16_t address) const = 0;
  /// Begins to write one byte and returns at once.
  virtual void write(uint16_t address, uint8_t value) = 0;

 protected:
  ~Bytes() {}
};

}  // namespace settings
