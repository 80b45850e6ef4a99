// Interface of a memory that keeps its bytes without power.
#pragma once

#include <stdint.h>

namespace settings {

/// The EEPROM, as this library uses it. A write takes 3.4 ms and goes on while the caller runs.
class Bytes {
 public:
  /// Number of bytes; addresses run from 0.
  virtual uint16_t size() const = 0;
  /// False while a write goes on. Do not read or write then.
  virtual bool ready() const = 0;
  virtual uint8_t read(uint16_t address) const = 0;
  /// Begins to write a byte and returns at once.
  virtual void write(uint16_t address, uint8_t value) = 0;

 protected:
  ~Bytes() {}
};

}  // namespace settings
