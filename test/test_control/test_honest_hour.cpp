// An hour of cutting with sound motors: no fault is seen, however motors stick and supplies sag.
#include <gtest/gtest.h>

#include "axis.h"

using motion::Fault;

namespace {

/// Moves and rests of any length, at any feed. The pull of the cut and the supply change all the
/// time.
class Work {
 public:
  Work(unsigned seed, double rate, const world::MotorConstants& constants)
      : axis(constants, seed, rate), rate_(rate), random_(seed) {}

  /// Works for `seconds`; returns the fault that was seen.
  Fault go(double seconds) {
    while (done_ < seconds * rate_) {
      const double feeds[] = {20, 60, 200, 500, 700};
      const double feed = feeds[random_() % 5];
      ToAndFro way(feed, axis.seconds, at_);
      const double length = random_() % 3 ? between(-0.6, 0.6) : between(-30, 30);
      const double goal = at_ + length * std::sqrt(feed / 800);
      while (!way.isAt(goal))
        if (tick(way.towards(goal))) return axis.fault;
      at_ = way.at();
      for (double rest = between(0, 2) * rate_; rest > 0; rest -= 1)
        if (tick({at_, 0})) return axis.fault;
    }
    return Fault::kNone;
  }

  Axis axis;

 private:
  bool tick(const Asked& asked) {
    if (random_() % 40 == 0) axis.motor.weaker = between(0, 1.5);
    if (random_() % 40 == 0) axis.motor.pull = between(-0.3, 0.3);
    axis.tick(asked);
    ++done_;
    return axis.fault != Fault::kNone;
  }

  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  double rate_, done_ = 0, at_ = 0;
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
