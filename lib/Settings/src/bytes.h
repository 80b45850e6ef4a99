// Interface of a memory that keeps its bytes without power.
#pragma once

#include <stdint.h>
#include <string.h>

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

/// The number in `size` bytes, low byte first.
inline uint32_t numberAt(const Bytes& bytes, uint16_t address, uint8_t size) {
  uint32_t number = 0;
  for (uint8_t i = 0; i < size; ++i)
    number |= uint32_t(bytes.read(uint16_t(address + i))) << (8 * i);
  return number;
}

/// A float's bits, as they are stored.
inline uint32_t bitsOf(float value) {
  uint32_t bits;
  memcpy(&bits, &value, sizeof bits);
  return bits;
}

/// The float of these bits.
inline float floatOf(uint32_t bits) {
  float value;
  memcpy(&value, &bits, sizeof value);
  return value;
}

}  // namespace settings
