// The axes' lengths, heights and simulated motion, and which axis makes them yield.
#include <gtest/gtest.h>

#include "prepared_axes.h"

using namespace machine;

namespace {

typedef PreparedAxes<BoardAtRest> Driven;

}  // namespace

TEST(AxesYield, ToAnyAxisThatIsFarBehind) {
  for (const Axis axis : {kLeftAxis, kRightAxis, kZAxis}) {
    Driven driven;
    driven.axes.follow();
    driven.ticks(2);
    EXPECT_FALSE(driven.axes.hasYielded()) << int(axis);
    driven.axes.jumpTo(axis, 1.9f);  // the limit is 2 mm
    driven.ticks(1);
    EXPECT_TRUE(driven.axes.hasYielded()) << int(axis);
    EXPECT_NEAR(1.9, double(driven.axes.mostBehind(axis)), 1e-4) << int(axis);
  }
}

TEST(AxesCounts, AreSetWithoutPowerOrMotion) {
  Driven driven;
  driven.axes.follow();
  driven.ticks(2);
  driven.axes.setCounts(200000, -300, 7);
  driven.ticks(1);
  EXPECT_FALSE(driven.axes.isPowered());
  for (const Axis axis : {kLeftAxis, kRightAxis, kZAxis}) {
    EXPECT_EQ(0, driven.board.duty[axis]);
    EXPECT_NEAR(0, double(driven.axes.error(axis)), 1e-4);
  }
}

TEST(AxesImagination, AHeightDeclaredInSimulationIsNotTheRealOne) {
  Driven driven;
  driven.axes.simulate(true);
  driven.axes.declareLifted(2);
  EXPECT_TRUE(driven.axes.isImagined());
}

TEST(AxesImagination, ChainsTurnedByHandDifferFromTheRecord) {
  for (const int sign : {-1, 1}) {
    Driven driven;
    driven.axes.simulate(true);
    driven.board.counted[kRightAxis] = uint16_t(12 * sign);
    driven.ticks(1);
    EXPECT_FALSE(driven.axes.isImagined()) << "0.1 mm, " << sign;
    EXPECT_EQ(0, driven.axes.counts(kRightAxis)) << "encoders do not count";
    driven.board.counted[kRightAxis] = uint16_t(13 * sign);
    driven.ticks(1);
    EXPECT_TRUE(driven.axes.isImagined()) << sign;
  }
}

TEST(AxesLengths, AreLimitedToTheMostTravel) {
  Driven driven;
  for (const float sign : {-1.0f, 1.0f}) {
    driven.axes.declare(kLeftAxis, sign * 1e9f);
    EXPECT_NEAR(double(driven.axes.length(kLeftAxis)), double(sign * kMostTravel), 0.01);
    EXPECT_NEAR(double(driven.axes.target(kLeftAxis)), double(sign * kMostTravel), 0.01);
    // Counts that were kept under other settings.
    driven.axes.setCounts(0, int32_t(sign) * 2000000000, 0);
    driven.axes.standStill();
    EXPECT_NEAR(double(driven.axes.target(kRightAxis)), double(sign * kMostTravel), 0.01);
  }
}

TEST(AxesLengths, StandingStillDropsWaitingSetPoints) {
  Driven driven;
  driven.axes.setPoints().vacant() = {{65536, 65536, 0}, 100, 10, 0};
  driven.axes.setPoints().push();
  EXPECT_FALSE(driven.axes.isEmpty());
  driven.axes.standStill();
  EXPECT_TRUE(driven.axes.isEmpty());
  EXPECT_EQ(0, driven.axes.waiting());
}

TEST(AxesDrive, EndsAtStandstillEvenWithALostEncoder) {
  Driven driven;
  driven.axes.follow();
  driven.axes.jumpTo(kLeftAxis, 1);
  driven.ticks(5);  // the encoder shows nothing
  EXPECT_NE(0, driven.board.duty[kLeftAxis]);
  driven.axes.standStill();
  driven.ticks(5);
  EXPECT_EQ(0, driven.board.duty[kLeftAxis]);
  EXPECT_TRUE(driven.axes.isPowered());
}
