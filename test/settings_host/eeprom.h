// A simulated EEPROM whose power can fail in any byte; that byte then holds noise.
#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <stdexcept>

#include "../../src/settings_table.h"

namespace settings_host {

/// Thrown when power fails: everything in RAM is lost.
struct PowerCut {};

/// 4096 bytes as the Mega has them: a write goes on for some calls of ready(), and wears its cell.
class Eeprom : public settings::Bytes {
 public:
  Eeprom() { cell_.fill(0xFF); }

  uint16_t size() const override { return uint16_t(cell_.size()); }

  bool ready() const override {
    if (busy_ == 0) return true;
    --busy_;
    return false;
  }

  uint8_t read(uint16_t address) const override {
    if (busy_) throw std::logic_error("read during a write");
    return cell_.at(address);
  }

  void write(uint16_t address, uint8_t value) override {
    if (busy_) throw std::logic_error("two writes at once");
    if (writes_left_ == 0) {
      cell_.at(address) = torn_ < 0 ? cell_.at(address) : uint8_t(torn_);
      throw PowerCut();
    }
    if (writes_left_ > 0) --writes_left_;
    if (cell_.at(address) == value) ++needless_writes;
    ++worn[address];
    ++writes;
    if (!dead[address]) cell_[address] = value;
    busy_ = busy_calls;
  }

  /// Makes power fail in the write after the next `writes`. `torn` is what that cell then holds;
  /// with -1 it holds its old byte.
  void cutAfter(int writes, int torn) {
    writes_left_ = writes;
    torn_ = torn;
  }

  /// Power is back.
  void restore() {
    writes_left_ = -1;
    busy_ = 0;
  }

  uint8_t& operator[](uint16_t address) { return cell_.at(address); }

  std::array<uint32_t, 4096> worn{};  ///< writes of each cell
  std::array<bool, 4096> dead{};      ///< cells that keep what they hold
  uint32_t writes = 0, needless_writes = 0;
  int busy_calls = 2;

 private:
  std::array<uint8_t, 4096> cell_;
  mutable int busy_ = 0;
  int writes_left_ = -1, torn_ = -1;
};

/// Lets memory work until it has nothing to do; the number of steps.
inline int settle(settings::Memory& memory) {
  int steps = 0;
  while (!memory.isIdle()) {
    memory.step();
    if (++steps > 100000) throw std::runtime_error("the EEPROM is never done");
  }
  return steps;
}

/// A machine's settings and position between two power cuts.
template <class Table>
struct Board {
  explicit Board(Eeprom& eeprom) : values(table, room.data()), memory(eeprom, values) {
    eeprom.restore();
    started = memory.start();
  }

  Table table;
  std::array<float, kSettingCount> room;
  settings::Values values;
  settings::Memory memory;
  settings::Started started;
};

}  // namespace settings_host
