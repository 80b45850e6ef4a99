// What drives the motors, and what a declaration of a length leaves of it.
#include <gtest/gtest.h>

#include <functional>

#include "prepared_axes.h"

using namespace machine;

namespace {

/// A board whose encoders may miss steps.
struct NoisyBoard : BoardAtRest {
  uint16_t illegalSteps(Axis) override { return illegal; }
  uint16_t illegal = 0;
};

typedef PreparedAxes<NoisyBoard> Powered;

}  // namespace

TEST(AxesPower, AnAxisTurnsAtASpeedWithoutItsPositionLoop) {
  Powered powered;
  EXPECT_FALSE(powered.axes.isDriven());
  powered.axes.turn(kLeftAxis, 10);
  EXPECT_TRUE(powered.axes.isDriven());
  EXPECT_TRUE(powered.axes.isPowered());
  EXPECT_FALSE(powered.axes.isFollowing(kLeftAxis));
  powered.ticks(3);
  EXPECT_LT(powered.board.duty[kLeftAxis], 0) << "it pays out";
  EXPECT_EQ(0, powered.board.duty[kRightAxis]);
  powered.axes.release(kLeftAxis);
  EXPECT_FALSE(powered.axes.isDriven() || powered.axes.isPowered());
  EXPECT_EQ(0, powered.axes.state(kLeftAxis).duty);
}

TEST(AxesPower, DutyIsLimitedToFull) {
  Powered powered;
  powered.axes.driveOpen(kLeftAxis, 300);
  powered.axes.driveOpen(kRightAxis, -300);
  powered.ticks(1);
  EXPECT_EQ(255, powered.board.duty[kLeftAxis]);
  EXPECT_EQ(-255, powered.board.duty[kRightAxis]);
  EXPECT_TRUE(powered.axes.isDriven());
}

TEST(AxesPower, AnAxisWithoutAGainIsNotWatchedAndSlowsNothing) {
  Powered powered;
  powered.values.setRow(kZPositionP, 0);
  powered.axes.prepare(powered.values);
  powered.axes.follow();
  powered.axes.jumpTo(kZAxis, 5);  // the limit is 2 mm
  powered.ticks(20);
  EXPECT_EQ(motion::Fault::kNone, powered.axes.fault().fault);
  EXPECT_FALSE(powered.axes.hasYielded());
  EXPECT_FALSE(powered.axes.isDisproved(kZAxis));
}

TEST(AxesPower, EachAxisUsesItsOwnSpeedGains) {
  for (const Axis axis : {kLeftAxis, kRightAxis, kZAxis}) {
    Powered powered;
    powered.values.setRow(axis == kZAxis ? kMainSpeedP : kZSpeedP, 0);
    powered.axes.prepare(powered.values);
    powered.axes.turn(axis, 10);
    powered.ticks(3);
    EXPECT_NE(0, powered.board.duty[axis]) << "by gains that are another axis's: " << int(axis);
  }
}

TEST(AxesPower, TurningBeginsFromRest) {
  Powered powered;
  powered.axes.follow();
  powered.axes.jumpTo(kLeftAxis, 1);
  powered.ticks(5);
  EXPECT_NE(0, powered.board.duty[kLeftAxis]);
  powered.axes.turn(kLeftAxis, 0);
  powered.ticks(1);
  EXPECT_EQ(0, powered.board.duty[kLeftAxis]);
}

TEST(AxesScale, ChangesOnceForEachNewScale) {
  Powered powered;
  EXPECT_FALSE(powered.axes.prepare(powered.values));
  powered.values.setRow(kEncoderCounts, 4000);
  EXPECT_TRUE(powered.axes.prepare(powered.values));
  EXPECT_FALSE(powered.axes.prepare(powered.values));
}

TEST(AxesPower, ALiftFeedsItsSpeedForward) {
  Powered lifted, jumped;
  lifted.axes.follow();
  jumped.axes.follow();
  lifted.axes.lift(8, 5, 50);
  lifted.ticks(1);
  jumped.axes.jumpTo(kZAxis, lifted.axes.target(kZAxis));
  jumped.ticks(1);
  EXPECT_GT(lifted.axes.state(kZAxis).wanted_rpm, jumped.axes.state(kZAxis).wanted_rpm + 0.1f);
}

TEST(AxesLengths, ADeclaredHeightEndsALift) {
  Powered powered;
  powered.axes.simulate(true);
  powered.axes.follow();
  powered.axes.lift(8, 5, 50);
  powered.ticks(20);
  EXPECT_TRUE(powered.axes.isLifted());
  powered.axes.declare(kZAxis, 3);
  EXPECT_FALSE(powered.axes.isLifted());
  powered.ticks(20);
  EXPECT_FLOAT_EQ(3, powered.axes.target(kZAxis));
}

TEST(AxesLengths, AForgottenPathEndsALift) {
  const std::function<void(Axes&)> forgetters[] = {
      [](Axes& axes) { axes.dropSetPoints(); },
      [](Axes& axes) { axes.standStill(); },
      [](Axes& axes) { axes.jumpTo(kLeftAxis, 1); },
  };
  for (const auto& forget : forgetters) {
    Powered powered;
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

TEST(AxesLengths, StepsMissedBeforeTheEncodersWereSetUpDoNotCount) {
  Powered powered;
  powered.board.illegal = 1000;
  EXPECT_TRUE(powered.axes.hasMissedSteps(kLeftAxis));
  powered.axes.forgetRawCounts();
  EXPECT_FALSE(powered.axes.hasMissedSteps(kLeftAxis));
  powered.board.illegal = 2000;
  EXPECT_TRUE(powered.axes.hasMissedSteps(kLeftAxis));
  powered.axes.declare(kLeftAxis, 100);
  EXPECT_FALSE(powered.axes.hasMissedSteps(kLeftAxis));
}
