// The EEPROM on the host: a byte takes its time to write, and power may go at any of them.
#pragma once

#include <Settings.h>

#include <cstdint>
#include <vector>

/// 4 KB that outlive a power cut.
class SimulatedEeprom : public settings::Bytes {
 public:
  uint16_t size() const override { return uint16_t(bytes.size()); }
  bool ready() const override { return busy_us_ <= 0; }
  uint8_t read(uint16_t address) const override { return bytes.at(address); }
  void write(uint16_t address, uint8_t value) override {
    bytes.at(address) = value;
    busy_us_ = 3400;
    ++writes;
  }

  void advance(int us) { busy_us_ -= us; }

  std::vector<uint8_t> bytes = std::vector<uint8_t>(4096, 0xff);
  long writes = 0;

 private:
  int busy_us_ = 0;
};
