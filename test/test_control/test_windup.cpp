// The loops' sums must not drive a motor too far after a time in which it could not follow.
#include <Motion.h>
#include <gtest/gtest.h>

using motion::AxisLoop;

namespace {

const float kWindupTick = 0.01f, kCounts = 8113.73f;

/// A loop at rest.
AxisLoop loopWith(const motion::Gains& position, const motion::Gains& speed) {
  AxisLoop loop;
  loop.tune(position, speed, kCounts, kWindupTick);
  loop.rest();
  return loop;
}

}  // namespace

TEST(Windup, OfThePositionLoopEndsAtTopSpeed) {
  // 5 turns of error and 2 per turn and second: 10 a second, so 20 are reached after 2 s.
  AxisLoop loop = loopWith({1, 2, 0, 1}, {7, 0, 0, 1});
  for (int i = 0; i < 10000; ++i) loop.follow(5, 0, 0);
  EXPECT_FLOAT_EQ(20, loop.wanted());
  for (int i = 0; i < 100; ++i) loop.follow(-5, 0, 0);
  EXPECT_NEAR(20 - 10 - 5, double(loop.wanted()), 0.01)
      << "a second later, less the proportional 5";
}

TEST(Windup, OfTheSpeedLoopEndsAtTopDuty) {
  // An error of 10 a minute and 20 per that and second: 200 a second.
  AxisLoop loop = loopWith({0, 0, 0, 1}, {0, 20, 0, 1});
  for (int i = 0; i < 10000; ++i) loop.run(10);
  // Now it runs at 20: the sum of 255 falls by 2 a tick.
  for (int i = 0; i < 4; ++i) loop.measure(20 * kWindupTick / 60);
  int ticks = 0;
  while (loop.run(10) > 0 && ticks < 1000) ++ticks, loop.measure(20 * kWindupTick / 60);
  EXPECT_NEAR(double(ticks), 127 + 16, 6) << "ticks until the duty has turned";
}

TEST(Windup, OfTheDutyEndsAtFullDuty) {
  AxisLoop loop = loopWith({0, 0, 0, 1}, {7, 0, 0, 1});
  for (int i = 0; i < 10000; ++i) loop.run(10);
  EXPECT_EQ(255, loop.run(10));
  EXPECT_EQ(255 - 70, loop.run(-10)) << "one tick of 7 per turn a minute";
  for (int i = 0; i < 10000; ++i) loop.run(-10);
  EXPECT_EQ(-255, loop.run(-10));
}
