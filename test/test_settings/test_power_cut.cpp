// Power may fail in any byte: afterwards either all settings are old or all are new.
#include <algorithm>

#include "boards.h"

namespace {

struct Change {
  const char* name;
  std::function<void(Board&)> act;
};

const Change kChanges[] = {
    {"one setting", [](Board& board) { board.memory.set(3, 468.4f); }},
    {"one bit", [](Board& board) { board.memory.set(16, 0); }},
    {"what a client sends",
     [](Board& board) {
       for (auto [number, value] : {std::pair<int, float>{8, 100}, {15, 800}, {16, 0}, {29, 1300}})
         board.memory.set(uint8_t(number), value);
     }},
    {"all", [](Board& board) { board.memory.reset(Reset::kSettings); }},
    {"a B code's row", [](Board& board) { board.memory.setRow(kZUpperLimit, 12.5f); }},
};

}  // namespace

TEST(PowerCut, LeavesTheOldOrTheNewSettings) {
  const Eeprom before = usedEeprom();
  int cuts = 0;
  for (const Change& change : kChanges) {
    Eeprom first = before, last = before;
    Board old_board(first), new_board(last);
    change.act(new_board);
    const auto old_values = valuesOf(old_board), new_values = valuesOf(new_board);
    ASSERT_NE(old_values, new_values) << change.name;
    bool seen_old = false, seen_new = false;
    cuts += cutEverywhere(
        before, change.act,
        [&](Board& board, int writes) {
          const auto values = valuesOf(board);
          seen_old |= values == old_values;
          seen_new |= values == new_values;
          ASSERT_TRUE(values == old_values || values == new_values) << change.name << " " << writes;
          ASSERT_EQ(Source::kStored, board.started.source);
          ASSERT_EQ(Known::kAtRest, board.started.known);
          ASSERT_TRUE(same(positionOf(1), board.started.position));
        },
        40);
    EXPECT_TRUE(seen_old && seen_new) << change.name;
  }
  std::printf("settings: power cut %d times\n", cuts);
  testing::Test::RecordProperty("cuts", cuts);
  EXPECT_GT(cuts, 4000);
}

TEST(PowerCut, InTheFirstSaveLeavesDefaultsOrTheSettings) {
  const auto act = [](Board& board) { board.memory.set(2, 3000); };
  int first_new = -1;
  const int cuts = cutEverywhere(
      Eeprom(), act,
      [&](Board& board, int writes) {
        const bool stored = board.values.at(kMotorGap) == 3000;
        ASSERT_EQ(stored ? Source::kStored : Source::kDefaults, board.started.source) << writes;
        if (stored && first_new < 0) first_new = writes;
        ASSERT_TRUE(stored || first_new < 0 || writes <= first_new) << writes;
        board.values.setRow(kMotorGap, 2978.4f);
        for (uint8_t i = 0; i < kSettingCount; ++i)
          ASSERT_EQ(board.table.at(i).usual, board.values.at(i));
      },
      1);
  std::printf("first save: power cut %d times\n", cuts);
  EXPECT_GT(cuts, 2000);
}

TEST(PowerCut, DuringTheRepairLosesNothing) {
  // The second cut comes while the start writes.
  const Eeprom before = usedEeprom();
  std::mt19937 random(22);
  int cuts = 0;
  for (int first = 0; first < 40; ++first) {
    Eeprom broken = before;
    try {
      Board board(broken);
      broken.cutAfter(first, int(random() & 0xFF));
      board.memory.set(3, 468.4f);
      board.memory.set(12, 8148);
      settle(board.memory);
    } catch (const PowerCut&) {
    }
    Eeprom copy = broken;
    const auto kept = valuesOf(Board(copy));
    broken.restore();
    cuts += cutEverywhere(
        broken, [](Board&) {},
        [&](Board& board, int writes) { ASSERT_EQ(kept, valuesOf(board)) << first << writes; }, 1);
  }
  std::printf("repair: power cut %d times\n", cuts);
  EXPECT_GT(cuts, 500);
}

TEST(PowerCut, DuringQuickChangesKeepsOneState) {
  // Settings arrive while others are being written, as in a client's sync.
  const Eeprom before = usedEeprom();
  std::mt19937 random(23);
  for (int run = 0; run < 3000; ++run) {
    Eeprom eeprom = before;
    std::vector<std::vector<float>> states;
    try {
      Board board(eeprom);
      states.push_back(valuesOf(board));
      eeprom.cutAfter(int(random() % 120), int(random() & 0xFF));
      for (int change = 0; change < 12; ++change) {
        board.memory.set(uint8_t(21 + random() % 3), float(random() % 1000));
        states.push_back(valuesOf(board));
        for (unsigned steps = random() % 90; steps > 0; --steps) board.memory.step();
        if (board.memory.settingsStored()) states.erase(states.begin(), states.end() - 1);
      }
      settle(board.memory);
      states.erase(states.begin(), states.end() - 1);
    } catch (const PowerCut&) {
    }
    Board after(eeprom);
    const auto found = valuesOf(after);
    ASSERT_NE(states.end(), std::find(states.begin(), states.end(), found)) << run;
  }
}

TEST(Copies, EachHoldsAllSettings) {
  Eeprom eeprom = usedEeprom();
  Board board(eeprom);
  board.memory.set(3, 468.4f);
  settle(board.memory);
  const auto kept = valuesOf(board);
  const uint16_t size = Copies::bytesFor(kSettingCount);
  for (uint16_t copy :
       {uint16_t(Memory::kFirstCopy), uint16_t(Memory::kFirstCopy + Memory::kApart)})
    for (uint16_t i = 0; i < size; ++i) {
      Eeprom worn = eeprom;
      worn[uint16_t(copy + i)] ^= uint8_t(1 << (i % 8));
      Board after(worn);
      ASSERT_EQ(kept, valuesOf(after)) << copy + i;
      settle(after.memory);
      ASSERT_EQ(eeprom[uint16_t(copy + i)], worn[uint16_t(copy + i)]) << "not repaired";
    }
}

TEST(Copies, AWornCellIsNoticedAndTheOtherCopyServes) {
  Eeprom eeprom = usedEeprom();
  eeprom.dead[Memory::kFirstCopy + 18] = true;
  {
    Board board(eeprom);
    for (float gap : {3000.1f, 3111.3f, 2999.7f}) {
      board.memory.set(2, gap);
      settle(board.memory);
    }
    EXPECT_TRUE(board.memory.isWorn());
    EXPECT_TRUE(board.memory.settingsStored());
  }
  EXPECT_FLOAT_EQ(2999.7f, Board(eeprom).values.at(kMotorGap));
}

TEST(Copies, WriteOnlyWhatChanges) {
  Eeprom eeprom = usedEeprom();
  Board board(eeprom);
  settle(board.memory);
  const uint32_t before = eeprom.writes;
  board.memory.set(3, 468.4f);
  settle(board.memory);
  // In each copy: at most four bytes of the value, two of the sequence number, four of the
  // checksum.
  EXPECT_LE(eeprom.writes - before, 20u);
  EXPECT_EQ(0u, eeprom.needless_writes);
  const uint32_t once = eeprom.writes;
  board.memory.set(3, 468.4f);
  settle(board.memory);
  EXPECT_EQ(once, eeprom.writes) << "the same value again";
}

TEST(Copies, AValueBeyondTodaysLimitsBecomesItsDefaultAndIsReported) {
  Eeprom eeprom = usedEeprom();
  {
    Board board(eeprom);
    // As if another version of this firmware had allowed the value.
    board.room[kMotorGap] = 99999;
    board.memory.set(3, 400);
    settle(board.memory);
  }
  Board after(eeprom);
  EXPECT_EQ(Source::kStoredInPart, after.started.source);
  EXPECT_EQ(2978.4f, after.values.at(kMotorGap));
  EXPECT_EQ(400, after.values.at(kMotorOffset));
}

namespace {

/// The table without a row: this firmware before it had that setting.
class ShorterTable : public FlashTable {
 public:
  static const uint8_t kMissing = kChainSpeed;
  uint8_t count() const override { return kSettingCount - 1; }
  Entry at(uint8_t index) const override {
    return FlashTable::at(index < kMissing ? index : uint8_t(index + 1));
  }
};

}  // namespace

TEST(Copies, ANewSettingInTheTableMovesNoOther) {
  Eeprom eeprom;
  {
    settings_host::Board<ShorterTable> board(eeprom);
    board.memory.set(69, 200);
    board.memory.set(201, 6.35f);
    board.memory.set(62, 120);
    settle(board.memory);
  }
  Board after(eeprom);
  EXPECT_EQ(Source::kStored, after.started.source);
  EXPECT_EQ(200, after.values.at(kLoopRate));
  EXPECT_EQ(120, after.values.at(kSledWeight));
  EXPECT_EQ(1000, after.values.at(kChainSpeed));
  EXPECT_EQ(6.35f, after.values.at(indexOf(after.table, 201)));
  after.memory.set(68, 900);
  settle(after.memory);
  settings_host::Board<ShorterTable> back(eeprom);
  EXPECT_EQ(200, back.values.at(indexOf(back.table, 69)));
}

namespace {

/// The table before G-code kept places.
class TableWithoutPlaces : public FlashTable {
 public:
  uint8_t count() const override { return kFirstPlaceSetting; }
};

}  // namespace

TEST(Copies, FromBeforePlacesAreRead) {
  Eeprom eeprom;
  {
    settings_host::Board<TableWithoutPlaces> board(eeprom);
    board.memory.set(2, 3100);
    board.memory.set(227, 0.4f);
    settle(board.memory);
  }
  Board after(eeprom);
  EXPECT_EQ(Source::kStored, after.started.source);
  EXPECT_EQ(3100, after.values.at(kMotorGap));
  EXPECT_EQ(0.4f, after.values.at(indexOf(after.table, 227)));
  EXPECT_EQ(0, after.values.at(kFirstPlaceSetting));
  EXPECT_EQ(kNoPlace, after.values.at(kSettingCount - 1));
  after.memory.setRow(kFirstPlaceSetting + 1, -12.5f);
  after.memory.setRow(kSettingCount - 1, 7);
  settle(after.memory);
  Board again(eeprom);
  EXPECT_EQ(3100, again.values.at(kMotorGap));
  EXPECT_EQ(-12.5f, again.values.at(kFirstPlaceSetting + 1));
  EXPECT_EQ(7, again.values.at(kSettingCount - 1));
}

TEST(Places, AreSetOnlyByGCode) {
  FlashTable table;
  EXPECT_EQ(kFirstPlaceSetting, indexOf(table, 230));
  EXPECT_EQ(kSettingCount - 1, indexOf(table, 253));
  for (uint8_t i = kFirstPlaceSetting; i < kSettingCount; ++i) {
    EXPECT_EQ(Access::kHidden, table.at(i).access);
    EXPECT_EQ(table.at(i).number >= 248 ? kNoPlace : 0, table.at(i).usual);
  }
}
