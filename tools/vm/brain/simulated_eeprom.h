// The EEPROM on the host: writing a byte takes time, and power may fail at any byte.
#pragma once

#include <Settings.h>

#include <cstdint>
#include <vector>

/// 4 KB that survive a power cut.
class SimulatedEeprom : public settings::Bytes {
 public:
  uint16_t size() const override { return uint16_t(bytes.size()); }
  bool ready() const override { return busy_us_ <= 0; }
  uint8_t read(uint16_t address) const override { return bytes.at(address); }
  void write(uint16_t address, uint8_t value) override {
    written_at_ = address;
    before_ = bytes.at(address);
    bytes.at(address) = value;
    busy_us_ = kWriteUs;
    ++writes;
  }

  void advance(int us) { busy_us_ -= us; }

  /// Power goes. A byte that is being written is first erased bit by bit, then takes its new value
  /// bit by bit; `draw` has a bit for each bit that has changed already.
  void tear(uint8_t draw) {
    if (ready()) return;
    uint8_t& byte = bytes.at(written_at_);
    byte = busy_us_ > kWriteUs / 2 ? uint8_t(before_ | draw) : uint8_t(byte | draw);
    busy_us_ = 0;
  }

  std::vector<uint8_t> bytes = std::vector<uint8_t>(4096, 0xff);
  long writes = 0;

 private:
  enum { kWriteUs = 3400 };

  int busy_us_ = 0;
  uint16_t written_at_ = 0;
  uint8_t before_ = 0xff;
};
