// The log of the board's faults: counts that survive a power cut in any byte.
#include <algorithm>

#include "boards.h"

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
