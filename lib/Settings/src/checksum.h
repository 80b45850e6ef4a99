// CRC-32 of bytes that come one by one: the CRC of Ethernet (IEEE 802.3).
#pragma once

#include <stdint.h>

namespace settings {

/// A running CRC-32. It detects every change within 32 neighbouring bits, and of other changes all
/// but 1 in 2^32.
class Checksum {
 public:
  Checksum() : register_(0xFFFFFFFF) {}

  void add(uint8_t byte) {
    register_ ^= byte;
    // Bit by bit. The usual table would take 1 KB; a table of 64 bytes would halve the time.
    for (uint8_t i = 0; i < 8; ++i) register_ = (register_ >> 1) ^ (register_ & 1 ? 0xEDB88320 : 0);
  }

  uint32_t value() const { return ~register_; }

 private:
  uint32_t register_;
};

}  // namespace settings
