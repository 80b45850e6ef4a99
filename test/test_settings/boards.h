// A board with the real table on a simulated EEPROM, and helpers to inspect it.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "../settings_host/eeprom.h"
#include "settings_flash.h"

using namespace settings;
using settings_host::Eeprom;
using settings_host::PowerCut;
using settings_host::settle;
using Board = settings_host::Board<FlashTable>;

inline std::vector<float> valuesOf(const Board& board) {
  return std::vector<float>(board.values.from(0), board.values.from(0) + kSettingCount);
}

/// Counts and a place that differ in every byte from those of another seed.
inline Position positionOf(int seed) {
  const uint32_t n = uint32_t(seed);
  Position position = {};
  position.left = int32_t(0x01234567 + n * 0x01010101);
  position.right = int32_t(0xFF43EB2 + n * 0x01030507);
  position.z = int32_t(99 - n * 0x00070301);
  position.x = 100.25f + float(seed);
  position.y = -50.5f - float(seed) * 0.37f;
  position.has_place = true;
  return position;
}

inline bool same(const Position& a, const Position& b) {
  return a.left == b.left && a.right == b.right && a.z == b.z && a.x == b.x && a.y == b.y;
}

/// An EEPROM as a machine leaves it that has been used for a while.
inline Eeprom usedEeprom() {
  Eeprom eeprom;
  Board board(eeprom);
  board.memory.set(2, 3602.6f);
  settle(board.memory);
  board.memory.set(8, 139.1f);
  board.memory.set(160, 8.2e-12f);
  board.memory.keepPosition(positionOf(1));
  settle(board.memory);
  return eeprom;
}

/// What a torn byte may hold: the old byte, all bits, no bits, or noise.
inline std::vector<int> tornBytes(std::mt19937& random, int noise) {
  std::vector<int> torn = {-1, 0x00, 0xFF};
  for (int i = 0; i < noise; ++i) torn.push_back(int(random() & 0xFF));
  return torn;
}

/// Does something to a board and lets it write until it is done, again and again: each time power
/// fails in another write, with several torn bytes. `look` inspects the board after each cut.
/// Returns the number of cuts.
inline int cutEverywhere(const Eeprom& before, const std::function<void(Board&)>& act,
                         const std::function<void(Board&, int)>& look, int noise = 4) {
  std::mt19937 random(21);
  int cuts = 0;
  for (int writes = 0;; ++writes) {
    bool was_cut = false;
    for (int torn : tornBytes(random, noise)) {
      Eeprom eeprom = before;
      try {
        Board board(eeprom);
        eeprom.cutAfter(writes, torn);
        act(board);
        settle(board.memory);
      } catch (const PowerCut&) {
        was_cut = true;
        ++cuts;
      }
      Board after(eeprom);
      look(after, writes);
      if (testing::Test::HasFailure()) return cuts;
    }
    if (!was_cut) return cuts;
  }
}
