// The axes: what drives their motors and what brakes them, their lengths, which faults they name,
// and what makes them yield.
#include <gtest/gtest.h>

#include <functional>

#include "board_at_rest.h"
#include "machine/axes.h"
#include "settings_flash.h"

using namespace machine;

/// A board whose encoders may miss steps.
struct NoisyBoard : BoardAtRest {
  uint16_t illegalSteps(Axis) override { return illegal; }
  uint16_t illegal = 0;
};

/// Axes with gains and no power.
struct PreparedAxes {
  PreparedAxes() : values(table, room) {
    values.setRow(kZPositionP, 1300);
    axes.prepare(values);
    axes.forgetRawCounts();
  }
  void ticks(int count) {
    for (int i = 0; i < count; ++i) axes.tick();
  }

  const FlashTable table;
  float room[kSettingCount];
  settings::Values values;
  NoisyBoard board;
  Axes axes{board, board};
};

namespace {

struct AxesAlone : testing::Test, PreparedAxes {};

/// Axes that follow, at zero.
struct Faults : testing::Test, PreparedAxes {
  Faults() { axes.follow(); }

  /// It turns the way it is driven, but too slowly.
  void leaveRightBehind() {
    for (int i = 1; i <= 12; ++i) {
      axes.jumpTo(kRightAxis, 0.25f * float(i));
      board.counted[kRightAxis] = uint16_t(board.counted[kRightAxis] + 8);
      ticks(1);
    }
  }
};

}  // namespace

TEST_F(Faults, OnlyTheAxisThatStandsLosesItsCounts) {
  axes.jumpTo(kLeftAxis, 50);
  ticks(120);
  EXPECT_EQ(motion::Fault::kStands, axes.fault().fault);
  EXPECT_TRUE(axes.isDisproved(kLeftAxis));
  EXPECT_FALSE(axes.isDisproved(kRightAxis));
  EXPECT_FALSE(axes.isDisproved(kZAxis));
}

TEST_F(Faults, AnAxisThatIsLeftBehindKeepsItsCounts) {
  leaveRightBehind();
  const Axes::AxisFault worst = axes.fault();
  EXPECT_EQ(motion::Fault::kLeftBehind, worst.fault);
  EXPECT_EQ(kRightAxis, worst.axis);
  EXPECT_FALSE(axes.isDisproved(kRightAxis));
}

TEST_F(Faults, TheWorstIsReported) {
  axes.jumpTo(kLeftAxis, 50);
  ticks(120);
  leaveRightBehind();
  const Axes::AxisFault worst = axes.fault();
  EXPECT_EQ(motion::Fault::kStands, worst.fault) << "the right axis is left behind later";
  EXPECT_EQ(kLeftAxis, worst.axis);
}

TEST_F(Faults, ANewStartForgetsThem) {
  axes.jumpTo(kLeftAxis, 50);
  ticks(120);
  axes.releaseAll();
  axes.standStill();
  axes.follow();
  EXPECT_EQ(motion::Fault::kNone, axes.fault().fault);
  EXPECT_FALSE(axes.isDisproved(kLeftAxis));
}

TEST(AxesYield, ToAnyAxisThatIsFarBehind) {
  for (const Axis axis : {kLeftAxis, kRightAxis, kZAxis}) {
    PreparedAxes driven;
    driven.axes.follow();
    driven.ticks(2);
    EXPECT_FALSE(driven.axes.hasYielded()) << int(axis);
    driven.axes.jumpTo(axis, 1.9f);  // the limit is 2 mm
    driven.ticks(1);
    EXPECT_TRUE(driven.axes.hasYielded()) << int(axis);
    EXPECT_NEAR(1.9, double(driven.axes.mostBehind(axis)), 1e-4) << int(axis);
  }
}

TEST_F(AxesAlone, CountsAreSetWithoutPowerOrMotion) {
  axes.follow();
  ticks(2);
  axes.setCounts(200000, -300, 7);
  ticks(1);
  EXPECT_FALSE(axes.isPowered());
  for (const Axis axis : {kLeftAxis, kRightAxis, kZAxis}) {
    EXPECT_EQ(0, board.duty[axis]);
    EXPECT_NEAR(0, double(axes.error(axis)), 1e-4);
  }
}

TEST_F(AxesAlone, AHeightDeclaredInSimulationIsNotTheRealOne) {
  axes.simulate(true);
  axes.declareLifted(2);
  EXPECT_TRUE(axes.isImagined());
}

TEST(AxesImagination, ChainsTurnedByHandDifferFromTheRecord) {
  for (const int sign : {-1, 1}) {
    PreparedAxes driven;
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

TEST_F(AxesAlone, LengthsAreLimitedToTheMostTravel) {
  for (const float sign : {-1.0f, 1.0f}) {
    axes.declare(kLeftAxis, sign * 1e9f);
    EXPECT_NEAR(double(axes.length(kLeftAxis)), double(sign * kMostTravel), 0.01);
    EXPECT_NEAR(double(axes.target(kLeftAxis)), double(sign * kMostTravel), 0.01);
    // Counts that were kept under other settings.
    axes.setCounts(0, int32_t(sign) * 2000000000, 0);
    axes.standStill();
    EXPECT_NEAR(double(axes.target(kRightAxis)), double(sign * kMostTravel), 0.01);
  }
}

TEST_F(AxesAlone, StandingStillDropsWaitingSetPoints) {
  axes.setPoints().vacant() = {{65536, 65536, 0}, 100, 10, 0};
  axes.setPoints().push();
  EXPECT_FALSE(axes.isEmpty());
  axes.standStill();
  EXPECT_TRUE(axes.isEmpty());
  EXPECT_EQ(0, axes.waiting());
}

TEST_F(AxesAlone, DriveEndsAtStandstillEvenWithALostEncoder) {
  axes.follow();
  axes.jumpTo(kLeftAxis, 1);
  ticks(5);  // the encoder shows nothing
  EXPECT_NE(0, board.duty[kLeftAxis]);
  axes.standStill();
  ticks(5);
  EXPECT_EQ(0, board.duty[kLeftAxis]);
  EXPECT_TRUE(axes.isPowered());
}

TEST_F(AxesAlone, AnAxisTurnsAtASpeedWithoutItsPositionLoop) {
  EXPECT_FALSE(axes.isDriven());
  axes.turn(kLeftAxis, 10);
  EXPECT_TRUE(axes.isDriven());
  EXPECT_TRUE(axes.isPowered());
  EXPECT_FALSE(axes.isFollowing(kLeftAxis));
  ticks(3);
  EXPECT_LT(board.duty[kLeftAxis], 0) << "it pays out";
  EXPECT_EQ(0, board.duty[kRightAxis]);
  axes.release(kLeftAxis);
  EXPECT_FALSE(axes.isDriven() || axes.isPowered());
  EXPECT_EQ(0, axes.state(kLeftAxis).duty);
}

TEST_F(AxesAlone, DutyIsLimitedToFull) {
  axes.driveOpen(kLeftAxis, 300);
  axes.driveOpen(kRightAxis, -300);
  ticks(1);
  EXPECT_EQ(255, board.duty[kLeftAxis]);
  EXPECT_EQ(-255, board.duty[kRightAxis]);
  EXPECT_TRUE(axes.isDriven());
}

TEST_F(AxesAlone, AnAxisWithoutAGainIsNotWatchedAndSlowsNothing) {
  values.setRow(kZPositionP, 0);
  axes.prepare(values);
  axes.follow();
  axes.jumpTo(kZAxis, 5);  // the limit is 2 mm
  ticks(20);
  EXPECT_EQ(motion::Fault::kNone, axes.fault().fault);
  EXPECT_FALSE(axes.hasYielded());
  EXPECT_FALSE(axes.isDisproved(kZAxis));
}

TEST(AxesPower, EachAxisUsesItsOwnSpeedGains) {
  for (const Axis axis : {kLeftAxis, kRightAxis, kZAxis}) {
    PreparedAxes powered;
    powered.values.setRow(axis == kZAxis ? kMainSpeedP : kZSpeedP, 0);
    powered.axes.prepare(powered.values);
    powered.axes.turn(axis, 10);
    powered.ticks(3);
    EXPECT_NE(0, powered.board.duty[axis]) << "by gains that are another axis's: " << int(axis);
  }
}

TEST_F(AxesAlone, TurningBeginsFromRest) {
  axes.follow();
  axes.jumpTo(kLeftAxis, 1);
  ticks(5);
  EXPECT_NE(0, board.duty[kLeftAxis]);
  axes.turn(kLeftAxis, 0);
  ticks(1);
  EXPECT_EQ(0, board.duty[kLeftAxis]);
}

TEST_F(AxesAlone, ScaleChangesOnceForEachNewScale) {
  EXPECT_FALSE(axes.prepare(values));
  values.setRow(kEncoderCounts, 4000);
  EXPECT_TRUE(axes.prepare(values));
  EXPECT_FALSE(axes.prepare(values));
}

TEST(AxesPower, ALiftFeedsItsSpeedForward) {
  PreparedAxes lifted, jumped;
  lifted.axes.follow();
  jumped.axes.follow();
  lifted.axes.lift(8, 5, 50);
  lifted.ticks(1);
  jumped.axes.jumpTo(kZAxis, lifted.axes.target(kZAxis));
  jumped.ticks(1);
  EXPECT_GT(lifted.axes.state(kZAxis).wanted_rpm, jumped.axes.state(kZAxis).wanted_rpm + 0.1f);
}

TEST_F(AxesAlone, ADeclaredHeightEndsALift) {
  axes.simulate(true);
  axes.follow();
  axes.lift(8, 5, 50);
  ticks(20);
  EXPECT_TRUE(axes.isLifted());
  axes.declare(kZAxis, 3);
  EXPECT_FALSE(axes.isLifted());
  ticks(20);
  EXPECT_FLOAT_EQ(3, axes.target(kZAxis));
}

TEST(AxesPower, AForgottenPathEndsALift) {
  const std::function<void(Axes&)> forgetters[] = {
      [](Axes& axes) { axes.dropSetPoints(); },
      [](Axes& axes) { axes.standStill(); },
      [](Axes& axes) { axes.jumpTo(kLeftAxis, 1); },
  };
  for (const auto& forget : forgetters) {
    PreparedAxes powered;
    powered.axes.simulate(true);
    powered.axes.follow();
    powered.axes.lift(8, 5, 50);
    powered.ticks(20);
    const float height = powered.axes.target(kZAxis);
    EXPECT_GT(height, 0.1f);
    forget(powered.axes);
    EXPECT_FALSE(powered.axes.isLifted());
    EXPECT_NEAR(height, powered.axes.plannedZ(), 0.001) << "z is where it is planned to be";
    powered.ticks(20);
    EXPECT_NEAR(height, powered.axes.target(kZAxis), 0.001) << "it goes no farther";
  }
}

TEST_F(AxesAlone, StepsMissedBeforeTheEncodersWereSetUpDoNotCount) {
  board.illegal = 1000;
  EXPECT_TRUE(axes.hasMissedSteps(kLeftAxis));
  axes.forgetRawCounts();
  EXPECT_FALSE(axes.hasMissedSteps(kLeftAxis));
  board.illegal = 2000;
  EXPECT_TRUE(axes.hasMissedSteps(kLeftAxis));
  axes.declare(kLeftAxis, 100);
  EXPECT_FALSE(axes.hasMissedSteps(kLeftAxis));
}

namespace {

const std::array<bool, 3> kAll = {true, true, true}, kNone = {false, false, false};

/// Axes that follow, at a rate of ticks [1/s].
struct Brakes : testing::TestWithParam<int>, PreparedAxes {
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
