// The keeper of the position: a record at rest is never valid while something may move.
#include <gtest/gtest.h>

#include <array>

#include "../settings_host/eeprom.h"
#include "board_at_rest.h"
#include "machine/position_keeper.h"
#include "settings_flash.h"

using namespace machine;
using settings::Known;

namespace {

/// A keeper with its axes and its EEPROM, through time.
class KeptMachine {
 public:
  explicit KeptMachine(settings_host::Eeprom& eeprom)
      : eeprom_(eeprom),
        values_(table_, room_),
        memory(eeprom, values_),
        axes(board, board),
        keeper(memory, axes) {
    const settings::Started started = memory.start();
    axes.prepare(values_);
    axes.setCounts(started.position.left, started.position.right, started.position.z);
    keeper.begin(started.known);
  }

  /// Lets time pass; stores a record when it is due.
  void pass(int ms) {
    for (int i = 0; i < ms; ++i) {
      if (++now_ms_ % 10 == 0) axes.tick();
      if (keeper.isDue(now_ms_)) {
        settings::Position position = {};
        position.left = axes.counts(kLeftAxis);
        position.right = axes.counts(kRightAxis);
        position.z = axes.counts(kZAxis);
        keeper.keep(position);
        ++kept;
      }
      memory.step();
    }
  }

  void wake() {
    keeper.beginMoving();
    for (int i = 0; i < 1000 && !keeper.mayMove(); ++i) pass(1);
    ASSERT_TRUE(keeper.mayMove());
    axes.follow();
    keeper.endWait();
  }

  /// What a start would read from the present EEPROM.
  settings::Started afterCut() {
    settings_host::Eeprom copy = eeprom_;
    copy.restore();
    float room[kSettingCount];
    settings::Values values(table_, room);
    return settings::Memory(copy, values).start();
  }

 private:
  settings_host::Eeprom& eeprom_;
  FlashTable table_;
  float room_[kSettingCount];
  settings::Values values_;
  uint32_t now_ms_ = 0;

 public:
  settings::Memory memory;
  BoardAtRest board;
  Axes axes;
  PositionKeeper keeper;
  int kept = 0;
};

/// A keeper whose chains were set, at rest, with its record stored.
struct Keeper : testing::Test {
  Keeper() : machine(eeprom) {
    machine.axes.declare(kLeftAxis, 1700);
    machine.axes.declare(kRightAxis, 1700);
    machine.keeper.declareChains();
    machine.pass(1000);
  }

  settings_host::Eeprom eeprom;
  KeptMachine machine;
};

}  // namespace

TEST_F(Keeper, SavesOnceAtRest) {
  EXPECT_EQ(Known::kAtRest, machine.afterCut().known);
  machine.pass(5000);
  EXPECT_EQ(1, machine.kept);
  EXPECT_TRUE(machine.keeper.isSettled());
}

TEST_F(Keeper, MarksUncommandedMotion) {
  machine.axes.driveOpen(kZAxis, 1);
  machine.pass(30);
  EXPECT_EQ(Known::kMoving, machine.afterCut().known);
  machine.pass(3000);
  EXPECT_EQ(1, machine.kept);
}

TEST_F(Keeper, WaitsForAMotorThatRunsOn) {
  machine.wake();
  machine.axes.releaseAll();
  for (int i = 0; i < 100; ++i) {
    machine.board.counted[kRightAxis] = uint16_t(machine.board.counted[kRightAxis] + 3);
    machine.pass(100);
    ASSERT_EQ(1, machine.kept) << "it still runs";
    ASSERT_EQ(Known::kMoving, machine.afterCut().known);
  }
  machine.pass(1000);
  EXPECT_EQ(2, machine.kept);
  EXPECT_EQ(machine.axes.counts(kRightAxis), machine.afterCut().position.right);
}

TEST_F(Keeper, WaitsForAMotorThatCreeps) {
  machine.wake();
  machine.axes.releaseAll();
  for (int i = 0; i < 30; ++i) {
    machine.board.counted[kRightAxis] = uint16_t(machine.board.counted[kRightAxis] + 2);
    machine.pass(100);
  }
  EXPECT_EQ(1, machine.kept);
}

TEST_F(Keeper, InvalidatesARecordWhoseChainIsPulled) {
  machine.board.counted[kLeftAxis] = 12;
  machine.pass(1000);
  EXPECT_EQ(Known::kAtRest, machine.afterCut().known) << "chains give way a little";
  EXPECT_EQ(1, machine.kept);
  machine.board.counted[kLeftAxis] = 13;
  machine.pass(30);
  EXPECT_EQ(Known::kMoving, machine.afterCut().known);
  machine.pass(1000);
  EXPECT_EQ(2, machine.kept);
  EXPECT_EQ(machine.axes.counts(kLeftAxis), machine.afterCut().position.left);
  machine.board.counted[kLeftAxis] = 0;
  machine.pass(30);
  EXPECT_EQ(Known::kMoving, machine.afterCut().known) << "back is as far";
}

TEST_F(Keeper, IgnoresAnEncoderFlickeringAtAnEdge) {
  machine.wake();
  machine.axes.releaseAll();
  for (int i = 0; i < 100; ++i) {
    machine.board.counted[kLeftAxis] = uint16_t(i % 2);
    machine.pass(10);
  }
  EXPECT_EQ(2, machine.kept);
}

TEST_F(Keeper, ADeclarationLeavesTheRecordUntilItIsKept) {
  machine.axes.declare(kLeftAxis, 1800);
  machine.keeper.declareChains();
  machine.pass(30);
  EXPECT_EQ(Known::kMoving, machine.afterCut().known);
  machine.pass(1000);
  EXPECT_EQ(Known::kAtRest, machine.afterCut().known);
  EXPECT_EQ(machine.axes.counts(kLeftAxis), machine.afterCut().position.left);
  machine.keeper.declareZ();
  machine.pass(30);
  EXPECT_EQ(Known::kMoving, machine.afterCut().known);
}

TEST_F(Keeper, ADeclarationOfTheSameLengthsCounts) {
  machine.keeper.declareChains();
  machine.pass(30);
  EXPECT_EQ(Known::kMoving, machine.afterCut().known);
  machine.pass(1000);
  EXPECT_EQ(2, machine.kept);
}

TEST_F(Keeper, ADeclarationBeforeMotorsHavePowerKeepsNothing) {
  machine.keeper.beginMoving();
  machine.keeper.reconsider();
  machine.pass(2000);
  EXPECT_EQ(1, machine.kept);
  EXPECT_EQ(Known::kMoving, machine.afterCut().known);
}

TEST_F(Keeper, AStopBeforeMotorsHavePowerComesBackToRest) {
  machine.keeper.beginMoving();
  machine.pass(2000);
  EXPECT_EQ(Known::kMoving, machine.afterCut().known) << "it may get power any moment";
  machine.keeper.endWait();
  machine.pass(1000);
  EXPECT_EQ(Known::kAtRest, machine.afterCut().known);
}

TEST_F(Keeper, ADoubtAboutZKeepsTheChainsTrusted) {
  machine.keeper.doubt(kZAxis, settings::Doubt::kCounts);
  machine.pass(1000);
  EXPECT_TRUE(machine.keeper.trustsChains());
  EXPECT_FALSE(machine.keeper.trustsAll());
  EXPECT_EQ(Known::kDoubted, machine.afterCut().known);
  machine.keeper.declareZ();
  machine.pass(1000);
  EXPECT_TRUE(machine.keeper.trustsAll());
  EXPECT_EQ(Known::kAtRest, machine.afterCut().known);
}
