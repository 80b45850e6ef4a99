// An hour of cutting with sound motors: no fault is seen, however motors stick and supplies sag.
#include <gtest/gtest.h>

#include "axis.h"

using motion::Fault;

namespace {

/// Moves and rests of any length, at any feed. The pull of the cut and the supply change all the
/// time.
class Work {
 public:
  /// `pull` [Nm] of a heavy sled, in addition to the usual load. So loaded a motor runs slowly.
  Work(unsigned seed, double rate, const world::MotorConstants& constants, double pull = 0)
      : axis(constants, seed, rate), rate_(rate), pull_(pull), random_(seed) {}

  /// Works for `seconds`; returns the fault that was seen.
  Fault go(double seconds) {
    while (done_ < seconds * rate_) {
      const double feeds[] = {20, 60, 200, 500, 700};
      const double feed = feeds[random_() % (pull_ > 0 ? 3 : 5)];
      const double length = random_() % 3 ? between(-0.6, 0.6) : between(-30, 30);
      if (move(at_ + length * std::sqrt(feed / 800), feed)) return axis.fault;
      for (double rest = between(0, 2) * rate_; rest > 0; rest -= 1)
        if (tick({at_, 0})) return axis.fault;
    }
    return Fault::kNone;
  }

  /// Moves to a goal [mm] at a feed [mm/min]; true if a fault was seen.
  bool move(double goal, double feed) {
    ToAndFro way(feed, axis.seconds, at_);
    while (!way.isAt(goal))
      if (tick(way.towards(goal))) return true;
    at_ = way.at();
    return false;
  }

  ControlledAxis axis;

 private:
  bool tick(const Asked& asked) {
    if (random_() % 40 == 0) axis.motor.weaker = between(0, 1.5);
    if (random_() % 40 == 0) axis.motor.pull = pull_ + between(-0.3, 0.3);
    axis.tick(asked);
    ++done_;
    return axis.fault != Fault::kNone;
  }

  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  double rate_, pull_, done_ = 0, at_ = 0;
  std::mt19937 random_;
};

class Honest : public testing::TestWithParam<double> {};

}  // namespace

INSTANTIATE_TEST_SUITE_P(Both, Honest, testing::Values(100.0, 200.0));

TEST_P(Honest, HourOfCuttingSeesNoFault) {
  for (unsigned seed = 0; seed < kMotors; ++seed) {
    world::MotorConstants constants = world::anyMotor(seed);
    // Every second motor sticks until it moves.
    constants.stiction = seed % 2 ? 1.5 : 1;
    Work work(seed, GetParam(), constants);
    EXPECT_EQ(Fault::kNone, work.go(3600.0 / kMotors)) << "motor " << seed;
  }
}

// With up to 200 N the chain of a heavy sled turns a motor against its friction while it lowers.
TEST_P(Honest, HeavySledSeesNoFault) {
  const double kPull = 0.9;
  for (unsigned seed = 0; seed < kMotors; ++seed) {
    Work work(seed, GetParam(), world::anyMotor(seed), kPull);
    // What a motor needs to raise the sled is learned in its first centimetres.
    ASSERT_FALSE(work.move(-20, 200)) << "motor " << seed;
    EXPECT_EQ(Fault::kNone, work.go(1800.0 / kMotors)) << "motor " << seed;
  }
}
