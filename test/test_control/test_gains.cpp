// What each gain of the two loops does, tick by tick; and their sums after a time in which a motor
// could not follow.
#include <Motion.h>
#include <gtest/gtest.h>

using motion::AxisLoop;
using motion::Gains;

namespace {

const float kTickSeconds = 0.01f, kCountsPerTurn = 8113.73f;
const float kPerMinute = 60 / kTickSeconds;  // ticks a minute
const Gains kNone = {0, 0, 0, 1};

AxisLoop loopWith(const Gains& position, const Gains& speed = kNone, float tick = kTickSeconds) {
  AxisLoop loop;
  loop.tune(position, speed, kCountsPerTurn, tick);
  loop.rest();
  return loop;
}

}  // namespace

TEST(Ahead, IsThirtyMillisecondsRoundedToTicks) {
  EXPECT_EQ(3, AxisLoop::ticksAhead(0.01f));
  EXPECT_EQ(6, AxisLoop::ticksAhead(0.005f));
  EXPECT_EQ(4, AxisLoop::ticksAhead(0.0085f)) << "3.53 ticks";
  EXPECT_EQ(3, AxisLoop::ticksAhead(0.0087f)) << "3.45 ticks";
}

TEST(PositionGains, FeedSpeedForwardOnlyWithANonZeroGain) {
  for (const float gain : {0.5f, 1300.0f}) {
    AxisLoop loop = loopWith({gain, 0, 0, 1});
    loop.follow(0, 0.001f, 0);
    EXPECT_NEAR(double(loop.wanted()), 6, 1e-4) << "gain " << gain;
  }
  AxisLoop loop = loopWith({0, 0, 0, 1});
  loop.follow(0, 0.001f, 0);
  EXPECT_EQ(0, loop.wanted());
  loop.tune({0.5f, 0, 0, 1}, kNone, kCountsPerTurn, kTickSeconds);
  loop.follow(0, 0.001f, 0);
  EXPECT_NEAR(double(loop.wanted()), 6, 1e-4);
  loop.tune({0, 0, 0, 1}, kNone, kCountsPerTurn, kTickSeconds);
  loop.follow(0, 0.001f, 0);
  EXPECT_EQ(0, loop.wanted()) << "a gain that was taken back";
}

TEST(PositionGains, EachActsOnItsOwn) {
  AxisLoop proportional = loopWith({4, 0, 0, 1});
  proportional.follow(0.5f, 0, 0);
  EXPECT_NEAR(double(proportional.wanted()), 2, 1e-5);
  proportional.follow(-0.5f, 0, 0);
  EXPECT_NEAR(double(proportional.wanted()), -2, 1e-5);

  AxisLoop derivative = loopWith({0, 0, 0.05f, 1});
  derivative.follow(0.5f, 0, 0);
  EXPECT_NEAR(double(derivative.wanted()), 0.05 / 0.01 * 0.5, 1e-5);
  derivative.follow(0.25f, 0, 0);
  EXPECT_NEAR(double(derivative.wanted()), -0.05 / 0.01 * 0.25, 1e-5);

  AxisLoop integral = loopWith({0, 10, 0, 1});
  for (int tick = 1; tick < 4; ++tick) {
    integral.follow(0.5f, 0, 0);
    EXPECT_NEAR(double(integral.wanted()), 10 * 0.01 * 0.5 * tick, 1e-5);
  }
}

TEST(PositionGains, WeightSplitsProportionalBetweenErrorAndMeasurement) {
  AxisLoop loop = loopWith({4, 0, 0, 0.25f});
  loop.follow(1, 0, 0);
  EXPECT_NEAR(double(loop.wanted()), 4 * 0.25, 1e-5) << "a jump of the set-point";
  loop.follow(0.75f, 0, 0.25f);
  EXPECT_NEAR(double(loop.wanted()), 4 * 0.25 - 4 * 0.25, 1e-5) << "less 4 for each turn it came";
  loop.tune({4, 0, 0, 1}, kNone, kCountsPerTurn, kTickSeconds);
  loop.follow(0.75f, 0, 0);
  EXPECT_NEAR(double(loop.wanted()), 4 * 0.75, 1e-5) << "the whole of it acts on the error";
  loop.tune({4, 0, 0, 0.25f}, kNone, kCountsPerTurn, kTickSeconds);
  loop.follow(0.75f, 0, 0);
  EXPECT_NEAR(double(loop.wanted()), 4 * 0.25 * 0.75, 1e-5) << "what was summed is forgotten";
}

TEST(PositionGains, IgnoreAnErrorOfOneCountAtRest) {
  const float count = 1 / kCountsPerTurn;
  for (const float sign : {-1.0f, 1.0f}) {
    AxisLoop loop = loopWith({1300, 0, 0, 1});
    loop.follow(sign * 1.49f * count, 0, 0);
    EXPECT_EQ(0, loop.wanted());
    loop.follow(sign * 1.51f * count, 0, 0);
    EXPECT_NEAR(double(loop.wanted()), double(sign * 1300 * 1.51f * count), 1e-5);
    loop.follow(sign * 1.49f * count, 1e-9f, 0);
    EXPECT_NEAR(double(loop.wanted()), double(sign * 1300 * 1.49f * count), 1e-4) << "moving";
  }
}

TEST(SpeedGains, ProportionalAddsToTheDutyEachTick) {
  AxisLoop loop = loopWith(kNone, {2, 0, 0, 1});
  EXPECT_EQ(20, loop.run(10));
  EXPECT_EQ(40, loop.run(10));
  EXPECT_EQ(20, loop.run(-10));
  // At twice the rate each tick adds half.
  AxisLoop quick = loopWith(kNone, {2, 0, 0, 1}, 0.005f);
  EXPECT_EQ(10, quick.run(10));
  EXPECT_EQ(20, quick.run(10));
}

TEST(SpeedGains, IntegralAccumulatesAndResetsWithItsGain) {
  // Each tick the sum grows by 32 * 0.01 * 10 = 3.2; the duty is a whole number.
  AxisLoop loop = loopWith(kNone, {0, 32, 0, 1});
  for (const int duty : {3, 9, 19}) EXPECT_EQ(duty, loop.run(10));
  loop.tune(kNone, {2, 0, 0, 1}, kCountsPerTurn, kTickSeconds);
  EXPECT_EQ(39, loop.run(10)) << "without the gain the sum is gone";
  loop.tune(kNone, {0, 32, 0, 1}, kCountsPerTurn, kTickSeconds);
  EXPECT_EQ(42, loop.run(10)) << "and begins at zero";
}

TEST(SpeedGains, DerivativeBrakesAnUncommandedChangeOfSpeed) {
  AxisLoop loop = loopWith({1, 0, 0, 1}, {0, 0, 0.02f, 1});
  EXPECT_EQ(0, loop.run(10)) << "a wish changes no speed";
  loop.measure(2 * 3 / kPerMinute);
  EXPECT_EQ(-6, loop.run(10)) << "3 turns a minute more, at 2 for each";
  // Set-points whose speed grows equally ask for this change: the smoothed speed is 1.5.
  AxisLoop led = loopWith({1, 0, 0, 1}, {0, 0, 0.02f, 1});
  led.measure(2 * 3 / kPerMinute);
  EXPECT_EQ(0, led.follow(0, 3 / kPerMinute, 0)) << "speed and set-points changed alike";
}

TEST(SpeedGains, WeightSplitsProportionalBetweenErrorAndMeasurement) {
  AxisLoop loop = loopWith(kNone, {7, 0, 0, 0.25f});
  EXPECT_EQ(17, loop.run(10)) << "7 * 0.25 * 10 = 17.5";
  loop.measure(2 * 3 / kPerMinute);
  EXPECT_EQ(14, loop.run(10)) << "17.5 + 7 * 0.25 * 7 - 7 * 0.75 * 3";
}

TEST(Measure, IsTheMeanOfTheLastTicks) {
  AxisLoop loop = loopWith(kNone);
  loop.measure(6 / kPerMinute);
  EXPECT_NEAR(double(loop.rpm()), 3, 1e-5);
  loop.measure(6 / kPerMinute);
  EXPECT_NEAR(double(loop.rpm()), 4.5, 1e-5);
  loop.rest();
  EXPECT_EQ(0, loop.rpm());
}

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
  for (int i = 0; i < 4; ++i) loop.measure(20 * kTickSeconds / 60);
  int ticks = 0;
  while (loop.run(10) > 0 && ticks < 1000) ++ticks, loop.measure(20 * kTickSeconds / 60);
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
