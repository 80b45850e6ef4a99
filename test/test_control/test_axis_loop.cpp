// The loops of an axis on motors with inertia, friction, back-EMF, load and a sagging supply.
#include <gtest/gtest.h>

#include <algorithm>

#include "axis.h"

namespace {

/// Worst error [mm] along 60 mm there and back with bounded acceleration, after the first tick.
double worstOnTheWay(unsigned seed, double rate, double feed) {
  ControlledAxis axis(seed, rate);
  ToAndFro way(feed, axis.seconds);
  double worst = 0;
  for (double goal : {60.0, 0.0})
    while (!way.isAt(goal)) worst = std::max(worst, std::fabs(axis.tick(way.towards(goal))));
  return worst;
}

std::vector<double> worstOfMotors(double rate, double feed) {
  std::vector<double> all;
  for (unsigned seed = 0; seed < kMotors; ++seed) all.push_back(worstOnTheWay(seed, rate, feed));
  std::sort(all.begin(), all.end());
  return all;
}

/// Largest distance [mm] past the goal of a move of 20 mm, with a second of rest.
double pastTheGoal(unsigned seed, double rate, double feed, double goal) {
  ControlledAxis axis(seed, rate);
  ToAndFro way(feed, axis.seconds);
  double most = 0;
  for (int rest = 0; rest < int(rate); rest += way.isAt(goal)) {
    const double error = axis.tick(way.towards(goal));
    if (way.isAt(goal)) most = std::max(most, std::copysign(1, goal) * -error);
  }
  return most;
}

}  // namespace

class AtRate : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Both, AtRate, testing::Values(100.0, 200.0));

TEST_P(AtRate, ChainsFollowWithinHalfAMillimetre) {
  for (double feed : {300.0, 800.0, 1000.0}) {
    const std::vector<double> all = worstOfMotors(GetParam(), feed);
    printf("%.0f Hz, %.0f mm/min: median %.3f mm, worst %.3f mm\n", GetParam(), feed,
           all[kMotors / 2], all.back());
    // The published alarm is at 2 mm. At the clients' greatest feed none of these motors comes near
    // it. At 1000 mm/min a quarter of them reaches full duty behind an L298.
    EXPECT_LT(all[kMotors / 2], 0.35);
    if (feed < 1000) {
      EXPECT_LT(all.back(), 0.9);
    }
  }
}

TEST_P(AtRate, AnAxisComesToRestAndStaysThere) {
  for (unsigned seed = 0; seed < kMotors; ++seed) {
    ControlledAxis axis(seed, GetParam());
    double lowest = 1e9, highest = -1e9;
    for (int i = 0; i < int(3 * GetParam()); ++i) {
      const double error = axis.tick(i < 20 ? 0.05 * i : 1.0);
      if (i < int(2 * GetParam())) continue;
      lowest = std::min(lowest, error);
      highest = std::max(highest, error);
    }
    EXPECT_LT(highest - lowest, 0.05) << "motor " << seed;
    EXPECT_LT(std::max(highest, -lowest), 0.1) << "motor " << seed;
  }
}

TEST_P(AtRate, AMoveEndsWithLittleOvershoot) {
  for (double feed : {300.0, 600.0, 800.0, 1000.0, 1200.0}) {
    std::vector<double> past;
    for (unsigned seed = 0; seed < kMotors; ++seed)
      for (double goal : {20.0, -20.0}) past.push_back(pastTheGoal(seed, GetParam(), feed, goal));
    std::sort(past.begin(), past.end());
    printf("%.0f Hz, %.0f mm/min: past the goal %.3f, worst %.3f mm\n", GetParam(), feed,
           past[kMotors], past.back());
    EXPECT_LT(past[kMotors], feed <= 1000 ? 0.025 : 0.06);
    if (feed <= 800) {
      EXPECT_LT(past.back(), 0.07);
    }
  }
}

TEST_P(AtRate, AStepOvershootsLittle) {
  for (unsigned seed = 0; seed < kMotors; ++seed) {
    ControlledAxis axis(seed, GetParam());
    double beyond = 0;
    for (int i = 0; i < int(2 * GetParam()); ++i) beyond = std::min(beyond, axis.tick(2.0));
    EXPECT_GT(beyond, -0.8) << "motor " << seed;
  }
}

TEST_P(AtRate, AMotorThatComesFreeDoesNotShootOff) {
  for (unsigned seed = 0; seed < kMotors; ++seed) {
    ControlledAxis axis(seed, GetParam());
    axis.motor.wires.blocked = true;
    for (int i = 0; i < int(GetParam()); ++i) axis.tick(1.5);
    EXPECT_EQ(255, axis.duty);
    axis.motor.wires.blocked = false;
    double beyond = 0, last = 0;
    for (int i = 0; i < int(2 * GetParam()); ++i) beyond = std::min(beyond, last = axis.tick(1.5));
    EXPECT_GT(beyond, -0.8) << "motor " << seed;
    EXPECT_LT(std::fabs(last), 0.1) << "motor " << seed;
  }
}

namespace {

const float kPerTick = 0.01f / 60;  // [turns] in a tick of 10 ms at 1 rpm

/// A loop whose motor stands, so that its duty grows, while set-points go on at a speed [rpm].
motion::AxisLoop drivenAt(float rpm) {
  motion::AxisLoop loop;
  loop.tune(kPosition, kSpeed, 8113.73f, 0.01f);
  loop.rest();
  loop.measure(0);
  for (int i = 0; i < 80; ++i) loop.follow(0, rpm * kPerTick, 0);
  return loop;
}

}  // namespace

TEST(AxisLoop, DropsItsDutyOnceWhenTheSetPointsTurnRound) {
  for (const float way : {1.0f, -1.0f}) {
    motion::AxisLoop loop = drivenAt(way * 0.3f);
    const float before = way * float(loop.follow(0, way * 0.3f * kPerTick, 0));
    ASSERT_GT(before, 100);
    // Only the new speed's duty is left.
    EXPECT_LT(way * float(loop.follow(0, -way * 0.3f * kPerTick, 0)), 0);
    // Driven against these set-points again, by an error, it keeps its duty.
    float pushed = 0;
    for (int i = 0; i < 20; ++i)
      pushed = way * float(loop.follow(way * 0.001f, -way * 0.3f * kPerTick, 0));
    EXPECT_GT(pushed, 50) << way;
  }
}

TEST(AxisLoop, KeepsItsDutyWhenTheSetPointsHardlyMove) {
  motion::AxisLoop loop = drivenAt(0.3f);
  ASSERT_GT(loop.follow(0, -0.24f * kPerTick, 0), 80);
  EXPECT_LT(loop.follow(0, -0.26f * kPerTick, 0), 0);
}

TEST(AxisLoop, KeepsADutyThatAlreadyDrivesTheNewWay) {
  motion::AxisLoop loop = drivenAt(5);
  for (int i = 0; i < 20; ++i) loop.follow(-0.01f, 5 * kPerTick, 0);
  const int before = loop.follow(-0.01f, 5 * kPerTick, 0);
  ASSERT_LT(before, -100);
  EXPECT_LT(loop.follow(-0.01f, -kPerTick, 0), before + 10);
}
