// The watch over an axis: it names every fault soon, and never reports a false fault.
#include <gtest/gtest.h>

#include "axis.h"

using motion::Fault;

namespace {

class Watched : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Both, Watched, testing::Values(100.0, 200.0));

/// What the watch says of a motor that gets a fault while it moves at 800 mm/min.
struct Said {
  Fault fault;
  double seconds;  ///< until the watch said it
  double astray;   ///< [mm] distance of the chain from its set-point then
};

Said saidOf(unsigned seed, double rate, const world::Wires& wires) {
  ControlledAxis axis(seed, rate);
  ToAndFro way(800, axis.seconds);
  for (int i = 0; i < int(rate); ++i) axis.tick(way.towards(60));
  axis.motor.wires = wires;
  for (int i = 1; i <= int(5 * rate); ++i) {
    const double astray = axis.tick(way.towards(60));
    if (axis.fault != Fault::kNone) return {axis.fault, i * axis.seconds, std::fabs(astray)};
  }
  return {Fault::kNone, 0, 0};
}

}  // namespace

TEST_P(Watched, CuttingIsNeverAFault) {
  for (unsigned seed = 0; seed < kMotors; ++seed) {
    ControlledAxis axis(seed, GetParam());
    ToAndFro way(800, axis.seconds);
    // Long moves, short moves and reversals in the middle of a move.
    double goals[] = {60, 0, 3, -3, 0.5, 0, 40, 20, 20.02, -30};
    for (const double goal : goals) {
      int ticks = 0;
      for (; !way.isAt(goal) || ticks < int(0.3 * GetParam()); ++ticks) {
        axis.tick(way.towards(goal));
        ASSERT_EQ(Fault::kNone, axis.fault) << "motor " << seed << " to " << goal;
      }
    }
  }
}

TEST_P(Watched, BlockedMotorAndUnpluggedEncoderAreReportedAsStanding) {
  for (unsigned seed = 0; seed < kMotors; ++seed) {
    world::Wires blocked, unplugged;
    blocked.blocked = true;
    unplugged.encoder_unplugged = true;
    const Said first = saidOf(seed, GetParam(), blocked);
    EXPECT_EQ(Fault::kStands, first.fault) << "motor " << seed;
    EXPECT_LT(first.seconds, 0.3) << "motor " << seed;
    const Said second = saidOf(seed, GetParam(), unplugged);
    EXPECT_EQ(Fault::kStands, second.fault) << "motor " << seed;
    EXPECT_LT(second.astray, 4) << "motor " << seed;
  }
}

TEST_P(Watched, ReversedMotorAndReversedEncoderAreReportedAsTurningBack) {
  for (unsigned seed = 0; seed < kMotors; ++seed) {
    world::Wires motor, encoder;
    motor.motor_reversed = true;
    encoder.encoder_reversed = true;
    for (const world::Wires& wires : {motor, encoder}) {
      // The fault is there from the first tick on, as after a repair.
      ControlledAxis axis(seed, GetParam());
      axis.motor.wires = wires;
      ToAndFro way(800, axis.seconds);
      for (int i = 0; i < int(GetParam()) && axis.fault == Fault::kNone; ++i)
        axis.tick(way.towards(60));
      EXPECT_EQ(Fault::kTurnsBack, axis.fault) << "motor " << seed;
      EXPECT_LT(std::fabs(axis.motor.turns()) * kTurnLength, 6) << "motor " << seed;
    }
  }
}

TEST(Watch, AWeakMotorIsLeftBehind) {
  motion::Watch watch;
  watch.tune(2, 8113.73f, 0.01f);
  for (int i = 0; i < 300; ++i) EXPECT_EQ(Fault::kNone, watch.look(255, 20, 1.9f));
  EXPECT_EQ(Fault::kLeftBehind, watch.look(255, 20, -2.0f));
  EXPECT_EQ(Fault::kLeftBehind, watch.look(255, 20, NAN));
}
