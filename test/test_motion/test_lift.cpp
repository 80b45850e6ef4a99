// Lifting z: to its goal and back, within speed and acceleration, to the count.
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "plain.h"

using namespace motion;

namespace {

const int32_t kTop = 432, kGain = 66;  // [counts/tick] z at 40 mm/min, 10 mm/s^2, 100 Hz

/// Ticks until z rests; speeds and their changes stay within the limits.
int run(Lift& lift, int32_t top = kTop, int32_t gain = kGain) {
  int ticks = 0;
  for (; !lift.isAtRest() && ticks < 1000000; ++ticks) {
    const int32_t before = lift.speed(), at = lift.at();
    lift.advance();
    EXPECT_EQ(lift.at() - at, lift.speed());
    EXPECT_LE(std::abs(lift.speed()), top);
    // The last step, onto the goal, may be up to two gains.
    EXPECT_LE(std::abs(lift.speed() - before), lift.at() == lift.goal() ? 2 * gain : gain);
  }
  return ticks;
}

}  // namespace

TEST(Lift, GoesToItsGoalAndBackInTheTimeOfATrapezoid) {
  Lift lift;
  for (const int32_t goal : {327680, -3000, 40, -1, 100000}) {
    lift.goTo(goal, kTop, kGain);
    const int32_t way = std::abs(goal - lift.at());
    const double most = double(way) / kTop + double(kTop) / kGain + 3;
    EXPECT_LE(run(lift), way > kTop * 10 ? most : 2 * std::sqrt(double(way) / kGain) + 4) << goal;
    EXPECT_EQ(goal, lift.at());
  }
  lift.goTo(0, kTop, kGain);
  run(lift);
  EXPECT_EQ(0, lift.at());
}

TEST(Lift, TakesANewGoalAtAnyMoment) {
  std::mt19937 random(5);
  Lift lift;
  for (int round = 0; round < 3000; ++round) {
    lift.goTo(int32_t(random() % 20000) - 10000, kTop, kGain);
    for (int i = int(random() % 60); i > 0 && !lift.isAtRest(); --i) {
      const int32_t before = lift.speed();
      lift.advance();
      EXPECT_LE(std::abs(lift.speed()), kTop);
      EXPECT_LE(std::abs(lift.speed() - before), 2 * kGain);
    }
  }
  run(lift);
  EXPECT_EQ(lift.goal(), lift.at());
}

TEST(Lift, StaysAtADeclaredHeight) {
  Lift lift;
  EXPECT_TRUE(lift.isAtRest());
  EXPECT_EQ(0, lift.at());
  EXPECT_EQ(0, lift.goal());
  lift.goTo(10000, kTop, kGain);
  for (int i = 0; i < 5; ++i) lift.advance();
  EXPECT_GT(lift.speed(), 0);
  lift.standAt(500);
  EXPECT_TRUE(lift.isAtRest());
  EXPECT_EQ(500, lift.at());
  lift.absorb();
  EXPECT_EQ(0, lift.at());
  EXPECT_TRUE(lift.isAtRest());
}

TEST(Lift, DoesNotOverflowWithAHugeGain) {
  Lift lift;
  lift.goTo(1000000000, 2000000000, 1);
  for (int i = 0; i < 2000; ++i) {
    lift.advance();
    EXPECT_GT(lift.speed(), 0);
    EXPECT_LE(lift.speed(), 1 << 17);
    // Braking takes at most a thousand ticks, whatever the commanded gain.
    EXPECT_EQ(std::min((i + 1) * ((1 << 17) / 1000 + 1), 1 << 17), lift.speed()) << i;
  }
  EXPECT_EQ(1 << 17, lift.speed());
}

TEST(Lift, BrakesAsSoonAsItCanAndStays) {
  std::mt19937 random(7);
  for (int round = 0; round < 300; ++round) {
    Lift lift;
    lift.goTo(round % 2 ? 20000 : -20000, kTop, kGain);
    for (unsigned i = random() % 60; i > 0; --i) lift.advance();
    const int32_t from = lift.at(), speed = lift.speed();
    lift.brake();
    const int32_t first = lift.goal();
    lift.advance();
    lift.brake();
    EXPECT_EQ(first, lift.goal()) << "a second hold changes nothing";
    run(lift);
    EXPECT_EQ(first, lift.at());
    EXPECT_LE(std::abs(lift.at() - from), speed * double(speed) / (2 * kGain));
    EXPECT_GE((lift.at() - from) * (speed < 0 ? -1 : 1), 0);
  }
}
