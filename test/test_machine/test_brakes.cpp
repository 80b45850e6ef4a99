// Motors that a fault stops: they are shorted for half a second, and let go then.
#include <gtest/gtest.h>

#include "board_at_rest.h"
#include "machine/axes.h"
#include "settings_flash.h"

using namespace machine;

namespace {

const std::array<bool, 3> kAll = {true, true, true}, kNone = {false, false, false};

/// Axes that follow, at a rate of ticks [1/s].
struct Brakes : testing::TestWithParam<int> {
  Brakes() : values(table, room), axes(board, board) {
    axes.setTicksPerSecond(float(GetParam()));
    axes.prepare(values);
    axes.follow();
    axes.jumpTo(kLeftAxis, 50);
    tick(20);
    EXPECT_NE(0, board.duty[kLeftAxis]);
  }

  void tick(int ticks) {
    for (; ticks > 0; --ticks) axes.tick();
  }

  FlashTable table;
  float room[kSettingCount];
  settings::Values values;
  BoardAtRest board;
  Axes axes;
};

}  // namespace

INSTANTIATE_TEST_SUITE_P(Both, Brakes, testing::Values(100, 200));

TEST_P(Brakes, HoldForHalfASecond) {
  axes.brakeAll();
  EXPECT_FALSE(axes.isPowered());
  EXPECT_EQ(kAll, board.shorted);
  tick(GetParam() / 2 - 1);
  EXPECT_EQ(kAll, board.shorted);
  tick(1);
  EXPECT_EQ(kNone, board.shorted);
  EXPECT_EQ(0, board.duty[kLeftAxis]);
}

TEST_P(Brakes, EndWhereAMotorIsLetGo) {
  axes.brakeAll();
  axes.releaseAll();
  EXPECT_EQ(kNone, board.shorted);
}

TEST_P(Brakes, EndWhereMotorsFollowAgain) {
  axes.brakeAll();
  axes.follow();
  tick(1);
  EXPECT_EQ(kNone, board.shorted);
  axes.jumpTo(kLeftAxis, 100);
  tick(GetParam() / 2);
  EXPECT_NE(0, board.duty[kLeftAxis]);
}

TEST_P(Brakes, AreNotUsedWhereAMotorIsLetGoAtRest) {
  axes.releaseAll();
  tick(GetParam());
  EXPECT_EQ(kNone, board.shorted);
}
