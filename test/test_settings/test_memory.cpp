// Nothing blocks, each reset erases what it should, and writing goes on while the machine runs.
#include "boards.h"

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
