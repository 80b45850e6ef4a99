// Motors that a fault stops: they are shorted for half a second, and let go then.
#include <gtest/gtest.h>

#include "prepared_axes.h"

using namespace machine;

namespace {

const std::array<bool, 3> kAll = {true, true, true}, kNone = {false, false, false};

/// Axes that follow, at a rate of ticks [1/s].
struct Brakes : testing::TestWithParam<int>, PreparedAxes<BoardAtRest> {
  Brakes() {
    axes.setTicksPerSecond(float(GetParam()));
    axes.prepare(values);
    axes.follow();
    axes.jumpTo(kLeftAxis, 50);
    ticks(20);
    EXPECT_NE(0, board.duty[kLeftAxis]);
  }
};

}  // namespace

INSTANTIATE_TEST_SUITE_P(Both, Brakes, testing::Values(100, 200));

TEST_P(Brakes, HoldForHalfASecond) {
  axes.brakeAll();
  EXPECT_FALSE(axes.isPowered());
  EXPECT_EQ(kAll, board.shorted);
  ticks(GetParam() / 2 - 1);
  EXPECT_EQ(kAll, board.shorted);
  ticks(1);
  EXPECT_EQ(kNone, board.shorted);
  EXPECT_EQ(0, board.duty[kLeftAxis]);
}

TEST_P(Brakes, EndWhenAMotorIsReleased) {
  axes.brakeAll();
  axes.releaseAll();
  EXPECT_EQ(kNone, board.shorted);
}

TEST_P(Brakes, EndWhenMotorsFollowAgain) {
  axes.brakeAll();
  axes.follow();
  ticks(1);
  EXPECT_EQ(kNone, board.shorted);
  axes.jumpTo(kLeftAxis, 100);
  ticks(GetParam() / 2);
  EXPECT_NE(0, board.duty[kLeftAxis]);
}

TEST_P(Brakes, AreNotUsedWhenAMotorIsReleasedAtRest) {
  axes.releaseAll();
  ticks(GetParam());
  EXPECT_EQ(kNone, board.shorted);
}
