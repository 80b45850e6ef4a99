// Power may fail in any byte, and no reset or event loses more than it should: all settings are old
// or all are new.
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

namespace {

Eeprom used() {
  Eeprom eeprom;
  Board board(eeprom);
  board.memory.set(2, 3602.6f);
  board.memory.set(180, 0.001f);
  board.memory.set(65, 150);
  board.memory.setRow(kSimulatedMotors, 1);
  board.memory.keepPosition(positionOf(1));
  settle(board.memory);
  return eeprom;
}

}  // namespace

TEST(Memory, WritesOneByteAStepWithoutWaiting) {
  Eeprom eeprom;
  eeprom.busy_calls = 40;
  Board board(eeprom);
  board.memory.set(2, 3000);
  board.memory.keepPosition(positionOf(1));
  uint32_t before = 0;
  while (!board.memory.isIdle()) {
    board.memory.step();
    // The simulated EEPROM throws if it is read or written while a write goes on.
    ASSERT_LE(eeprom.writes - before, 1u);
    before = eeprom.writes;
  }
  EXPECT_GT(eeprom.writes, 400u);
}

TEST(Memory, MotionWaitsOnlyForItsMark) {
  Eeprom eeprom = used();
  Board board(eeprom);
  settle(board.memory);
  board.memory.reset(Reset::kSettings);
  for (int i = 0; i < 20; ++i) board.memory.step();
  board.memory.beginMoving();
  const uint32_t before = eeprom.writes;
  while (!board.memory.mayMove()) board.memory.step();
  EXPECT_LE(eeprom.writes - before, 2u);
  EXPECT_FALSE(board.memory.settingsStored());
  settle(board.memory);
  EXPECT_TRUE(board.memory.settingsStored());
  EXPECT_TRUE(board.memory.mayMove());
}

TEST(Memory, StoresEverythingOnceTheFirstSettingIsSentToANewBoard) {
  Eeprom eeprom;
  {
    Board board(eeprom);
    ASSERT_EQ(Source::kDefaults, board.started.source);
    board.memory.set(2, 2978.4f);
    settle(board.memory);
  }
  EXPECT_EQ(Source::kStored, Board(eeprom).started.source);
}

TEST(Memory, RefusesWithoutWriting) {
  Eeprom eeprom = used();
  Board board(eeprom);
  const uint32_t before = eeprom.writes;
  EXPECT_EQ(Refusal::kOutOfRange, board.memory.set(2, 0));
  EXPECT_EQ(Refusal::kHidden, board.memory.set(43, 0));
  EXPECT_EQ(Refusal::kUnknown, board.memory.set(14, 0));
  EXPECT_TRUE(board.memory.isIdle());
  EXPECT_EQ(before, eeprom.writes);
  Eeprom fresh;
  Board new_board(fresh);
  EXPECT_EQ(Refusal::kOutOfRange, new_board.memory.set(2, 0));
  EXPECT_TRUE(new_board.memory.isIdle());
}

TEST(Reset, OfSettingsKeepsThePosition) {
  Eeprom eeprom = used();
  {
    Board board(eeprom);
    board.memory.reset(Reset::kSettings);
    EXPECT_EQ(2978.4f, board.values.at(kMotorGap));
    EXPECT_EQ(0, board.values.at(indexOf(board.table, 180)));
    EXPECT_EQ(100, board.values.at(kAccelerationXy));
    EXPECT_EQ(1, board.values.at(kSimulatedMotors));
    settle(board.memory);
  }
  Board after(eeprom);
  EXPECT_EQ(2978.4f, after.values.at(kMotorGap));
  EXPECT_EQ(Known::kAtRest, after.started.known);
  EXPECT_TRUE(same(positionOf(1), after.started.position));
}

TEST(Reset, OfEverythingLeavesDefaults) {
  Eeprom eeprom = used();
  {
    Board board(eeprom);
    board.memory.reset(Reset::kEverything);
    settle(board.memory);
  }
  Board after(eeprom);
  EXPECT_EQ(Known::kNothing, after.started.known);
  for (uint8_t i = 0; i < kSettingCount; ++i)
    EXPECT_EQ(after.table.at(i).usual, after.values.at(i));
}

TEST(Reset, CutAnywhereNeverRevivesAForgottenPosition) {
  const int cuts = cutEverywhere(
      used(), [](Board& board) { board.memory.reset(Reset::kEverything); },
      [](Board& board, int) {
        const bool old_settings = board.values.at(kMotorGap) == 3602.6f;
        ASSERT_TRUE(old_settings || board.values.at(kMotorGap) == 2978.4f);
        ASSERT_TRUE(old_settings || board.started.known == Known::kNothing);
      },
      1);
  EXPECT_GT(cuts, 200);
}

TEST(Scale, ChangesAreNoticed) {
  for (int number : {12, 13, 19, 20}) {
    Eeprom eeprom = used();
    {
      Board board(eeprom);
      ASSERT_EQ(board.memory.scale(), board.started.position.scale);
      board.memory.set(2, 3000);
      settle(board.memory);
    }
    {
      Board board(eeprom);
      EXPECT_EQ(board.memory.scale(), board.started.position.scale)
          << "the gap does not scale counts";
      const float was = board.values.at(indexOf(board.table, uint8_t(number)));
      board.memory.set(uint8_t(number), was * 1.001f);
      settle(board.memory);
    }
    Board after(eeprom);
    EXPECT_NE(after.memory.scale(), after.started.position.scale) << number;
  }
}

TEST(Memory, FitsBesideThePublishedMap) {
  EXPECT_LE(Memory::kFirstCopy + Memory::kApart, Memory::kFirstSlot - Memory::kApart);
  EXPECT_LE(Memory::kFirstSlot + Memory::kSlots * PositionSlots::kBytesPerSlot, 4095);
  EXPECT_LE(Copies::bytesFor(kSettingCount), Memory::kCopyRoom);
  EXPECT_LE(Memory::kFirstLog + EventLog::kBytes, Memory::kFirstCopy + Memory::kApart);
}

namespace {

const Event kEvents[] = {Event::kBrownOut, Event::kWatchdog, Event::kSupplyLow,
                         Event::kDriverFails};

int sumOfCounts(const EventLog& log) {
  int sum = 0;
  for (const Event event : kEvents) sum += log.count(event);
  return sum;
}

/// A used EEPROM in which each kind has happened as often as its number, the supply's last.
Eeprom logged() {
  Eeprom eeprom = usedEeprom();
  Board board(eeprom);
  for (const Event event : {Event::kWatchdog, Event::kDriverFails, Event::kDriverFails,
                            Event::kDriverFails, Event::kSupplyLow, Event::kSupplyLow}) {
    board.memory.note(event);
    settle(board.memory);
  }
  return eeprom;
}

}  // namespace

TEST(EventLog, BeginsEmptyAndCountsEachKind) {
  Eeprom fresh;
  EXPECT_EQ(0, Board(fresh).memory.log().total());
  Eeprom eeprom = logged();
  const Board board(eeprom);
  const EventLog& log = board.memory.log();
  EXPECT_EQ(0, log.count(Event::kBrownOut));
  EXPECT_EQ(1, log.count(Event::kWatchdog));
  EXPECT_EQ(2, log.count(Event::kSupplyLow));
  EXPECT_EQ(3, log.count(Event::kDriverFails));
  EXPECT_EQ(6, log.total());
  EXPECT_EQ(Event::kSupplyLow, log.last());
}

TEST(EventLog, HasTheOldOrTheNewCountsWhereverPowerFails) {
  Eeprom before = logged();
  const auto values = valuesOf(Board(before));
  bool seen_old = false, seen_new = false;
  const int cuts = cutEverywhere(
      before, [](Board& board) { board.memory.note(Event::kBrownOut); },
      [&](Board& board, int writes) {
        const EventLog& log = board.memory.log();
        const bool is_new = log.total() == 7;
        (is_new ? seen_new : seen_old) = true;
        ASSERT_TRUE(is_new || log.total() == 6) << writes;
        ASSERT_EQ(log.total(), sumOfCounts(log)) << writes;
        ASSERT_EQ(is_new ? 1 : 0, log.count(Event::kBrownOut)) << writes;
        ASSERT_EQ(is_new ? Event::kBrownOut : Event::kSupplyLow, log.last()) << writes;
        ASSERT_EQ(values, valuesOf(board));
        ASSERT_EQ(Known::kAtRest, board.started.known);
      },
      40);
  EXPECT_TRUE(seen_old && seen_new);
  std::printf("%d power cuts in the log\n", cuts);
}

TEST(EventLog, AcceptsAnEventWhileAnotherIsWritten) {
  for (int steps = 0; steps < 40; ++steps) {
    Eeprom eeprom = logged();
    {
      Board board(eeprom);
      board.memory.note(Event::kBrownOut);
      for (int i = 0; i < steps; ++i) board.memory.step();
      board.memory.note(Event::kDriverFails);
      settle(board.memory);
    }
    const Board after(eeprom);
    ASSERT_EQ(8, after.memory.log().total()) << steps;
    ASSERT_EQ(8, sumOfCounts(after.memory.log())) << steps;
    ASSERT_EQ(Event::kDriverFails, after.memory.log().last());
  }
}

TEST(EventLog, StopsBeforeItWearsOutACell) {
  Eeprom eeprom = usedEeprom();
  Board board(eeprom);
  eeprom.worn = {};
  for (int i = 0; i < EventLog::kMost + 50; ++i)
    for (const Event event : kEvents) {
      board.memory.note(event);
      settle(board.memory);
    }
  for (const Event event : kEvents) EXPECT_EQ(9999, board.memory.log().count(event));
  EXPECT_EQ(4 * 9999, board.memory.log().total());
  EXPECT_LE(*std::max_element(eeprom.worn.begin(), eeprom.worn.end()), 20000u);
  EXPECT_EQ(4 * 9999, Board(eeprom).memory.log().total());
}

TEST(EventLog, GivesUpAtAWornCellAndKeepsTheOtherRecord) {
  for (int cell = 0; cell < EventLog::kBytes; ++cell) {
    Eeprom eeprom = logged();
    for (const uint16_t at : {uint16_t(Memory::kFirstLog), uint16_t(Memory::kFirstLog + 800)}) {
      Eeprom copy = eeprom;
      copy.dead[uint16_t(at + cell)] = true;
      Board board(copy);
      board.memory.note(Event::kWatchdog);
      settle(board.memory);
      const int total = Board(copy).memory.log().total();
      EXPECT_TRUE(total == 6 || total == 7) << cell;
    }
  }
}

TEST(EventLog, OutlivesEveryReset) {
  Eeprom eeprom = logged();
  Board board(eeprom);
  board.memory.reset(Reset::kEverything);
  settle(board.memory);
  EXPECT_EQ(6, Board(eeprom).memory.log().total());
}
