// When a motor owes too much travel for its duty: in ticks, compared with a weak motor.
#include <Motion.h>
#include <gtest/gtest.h>

using motion::DueTravel;

namespace {

const float kTick = 0.01f, kCounts = 8113.73f;
const int16_t kMean = DueTravel::kMean;

DueTravel atRest(float counts = kCounts, float tick = kTick) {
  DueTravel due;
  due.tune(counts, tick);
  due.rest();
  return due;
}

/// Ticks until too much is due at a steady duty, with `moved` counts each tick; 0: not in 10 s.
int ticksUntilDue(DueTravel due, int duty, int moved) {
  for (int i = 1; i <= 1000; ++i)
    if (due.look(int16_t(duty * kMean), int16_t(moved * kMean), int16_t(moved))) return i;
  return 0;
}

/// Lets it learn the duty of a motor that runs evenly.
DueTravel learned(int duty, int moved, int ticks) {
  DueTravel due = atRest();
  for (int i = 0; i < ticks; ++i)
    due.look(int16_t(duty * kMean), int16_t(moved * kMean), int16_t(moved));
  due.rest();
  return due;
}

}  // namespace

// A weak motor makes 0.0014 turns a second for each step of duty beyond the duty that it needs, and
// 0.007 turns may be due. Before it has run, the needed duty is 120; the margin is an eighth of
// that and 15.
TEST(DueTravel, IsWhatAWeakMotorWouldTravelBeyondItsMargin) {
  for (const int sign : {-1, 1}) {
    EXPECT_EQ(0, ticksUntilDue(atRest(), sign * 150, 0));
    EXPECT_EQ(51, ticksUntilDue(atRest(), sign * 160, 0))
        << "0.007 / (10 * 0.0014 * 0.01) and a rest";
    EXPECT_NEAR(505, ticksUntilDue(atRest(), sign * 151, 0), 10) << "a step beyond the margin";
    EXPECT_EQ(5, ticksUntilDue(atRest(), sign * 255, 0)) << "0.007 / (105 * 0.0014 * 0.01)";
  }
  // At twice the rate it takes as many seconds.
  EXPECT_NEAR(ticksUntilDue(atRest(kCounts, 0.005f), 160, 0), 101, 4);
}

TEST(DueTravel, IsReducedByFourForEachCount) {
  EXPECT_EQ(0, ticksUntilDue(atRest(), 255, 3)) << "11.9 counts are due, 12 paid";
  EXPECT_EQ(8, ticksUntilDue(atRest(), 255, 1)) << "56.8 counts at 11.9 - 4 a tick";
}

// The chain of a heavy sled turns its motor against a drive that brakes.
TEST(DueTravel, DoesNotGrowWhenTheMotorTurnsAgainstTheDrive) {
  EXPECT_EQ(0, ticksUntilDue(atRest(), 130, -1));
  EXPECT_EQ(0, ticksUntilDue(atRest(), 130, -2));
  EXPECT_EQ(5, ticksUntilDue(atRest(), 255, -1)) << "as if none came";
}

// A broken channel counts to and fro. 11.9 counts are due a tick, 4 are paid for each that comes.
TEST(DueTravel, IsNotReducedByCountsToAndFro) {
  const auto ticks = [](std::initializer_list<int> moved) {
    DueTravel due = atRest();
    for (int i = 1; i < 100; ++i)
      if (due.look(255 * kMean, 0, int16_t(moved.begin()[i % int(moved.size())]))) return i;
    return 0;
  };
  EXPECT_EQ(5, ticks({1, -1})) << "a count goes, and the next comes back";
  EXPECT_EQ(6, ticks({1, 1, -2})) << "only the first pays";
  EXPECT_EQ(0, ticks({0, -9, 9, 9, 9})) << "more than two that go are travel, and what comes pays";
  EXPECT_EQ(0, ticks({3, 3}));
}

// 11.9 counts are due a tick, up to 56.8. Up to two that went must come back before any pays.
TEST(DueTravel, CountsBackwardsMustBeMadeUpFirst) {
  const auto ticks = [](std::initializer_list<int> first) {
    DueTravel due = atRest();
    for (const int moved : first) EXPECT_FALSE(due.look(255 * kMean, 0, int16_t(moved)));
    return int(first.size()) + ticksUntilDue(due, 255, 1);
  };
  EXPECT_EQ(8, ticks({}));
  EXPECT_EQ(7, ticks({-1}));
  EXPECT_EQ(6, ticks({-1, -1}));
  EXPECT_EQ(6, ticks({-2}));
  EXPECT_EQ(6, ticks({-9})) << "as if two";
}

TEST(DueTravel, IsNotReducedInAdvanceByEarlierTravel) {
  DueTravel due = atRest();
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(due.look(255 * kMean, 0, 9));
  EXPECT_EQ(5, ticksUntilDue(due, 255, 0)) << "as of a motor that never moved";
}

TEST(DueTravel, IsKeptThroughATickWithoutDuty) {
  DueTravel due = atRest();
  for (int i = 0; i < 40; ++i) EXPECT_FALSE(due.look(160 * kMean, 0, 0)) << i;
  EXPECT_FALSE(due.look(0, 0, 0));
  EXPECT_EQ(51 - 40, ticksUntilDue(due, 160, 0));
}

TEST(DueTravel, ForgetsLostCountsAtRestAndInTheOtherDirection) {
  DueTravel due = atRest();
  due.look(255 * kMean, 0, -2);
  due.rest();
  EXPECT_EQ(8, ticksUntilDue(due, 255, 1));
  due.look(255 * kMean, 0, -2);
  due.look(-255 * kMean, 0, 0);
  EXPECT_EQ(8, ticksUntilDue(due, 255, 1));
}

TEST(DueTravel, BeginsAgainInTheOtherDirectionAndAtRest) {
  DueTravel due = atRest();
  for (int i = 0; i < 40; ++i) EXPECT_FALSE(due.look(160 * kMean, 0, 0)) << i;
  EXPECT_FALSE(due.look(-160 * kMean, 0, 0));
  EXPECT_EQ(51, ticksUntilDue(due, 160, 0));
  due.rest();
  EXPECT_EQ(51, ticksUntilDue(due, 160, 0));
}

TEST(DueTravel, LearnsEachDirectionSeparately) {
  // The usual motor makes 0.002 turns a second for each step of duty. 20 counts a tick need 123
  // steps, so 77 of 200 overcome friction and load. With the margin that is 77 + 9 + 15 = 101.
  const DueTravel forward = learned(200, 20, 500);
  EXPECT_EQ(0, ticksUntilDue(forward, 100, 0));
  EXPECT_NEAR(ticksUntilDue(forward, 121, 0), 27, 2);
  EXPECT_EQ(0, ticksUntilDue(forward, -150, 0)) << "the other way it still needs 120";
  EXPECT_EQ(51, ticksUntilDue(forward, -160, 0));
  const DueTravel backward = learned(-200, -20, 500);
  EXPECT_EQ(51, ticksUntilDue(backward, 160, 0));
  EXPECT_NEAR(ticksUntilDue(backward, -121, 0), 27, 2);
}

TEST(DueTravel, GrowsAtFullDutyForTheStiffestMotor) {
  const DueTravel stiff = learned(255, 2, 1000);
  EXPECT_EQ(0, ticksUntilDue(stiff, 210, 0));
  EXPECT_EQ(51, ticksUntilDue(stiff, 220, 0)) << "210 is the most that it may need";
}

TEST(DueTravel, LearnsNothingFromASlowOrUnevenMotor) {
  EXPECT_EQ(51, ticksUntilDue(learned(200, 1, 500), 160, 0)) << "a count a tick";
  DueTravel uneven = atRest();
  for (int i = 0; i < 500; ++i) uneven.look(200 * kMean, 20 * kMean, int16_t(i % 2 ? 22 : 18));
  uneven.rest();
  EXPECT_EQ(51, ticksUntilDue(uneven, 160, 0)) << "two counts from the mean";
  DueTravel even = atRest();
  for (int i = 0; i < 500; ++i) even.look(200 * kMean, 20 * kMean, int16_t(i % 2 ? 21 : 19));
  even.rest();
  EXPECT_NEAR(ticksUntilDue(even, 121, 0), 27, 2) << "one count from the mean is even";
  for (const int16_t moved : {19, 21}) {
    DueTravel apart = atRest();
    for (int i = 0; i < 500; ++i) apart.look(200 * kMean, 20 * kMean, moved);
    apart.rest();
    EXPECT_NEAR(ticksUntilDue(apart, 121, 0), 27, 2) << moved;
  }
}

// 150 steps for two counts a tick: 138 of them overcome friction and load, 18 more than it knew.
TEST(DueTravel, LearnsAnEighthOfTheDifferenceEachTick) {
  EXPECT_EQ(0, ticksUntilDue(learned(150, 2, 1000), 169, 0)) << "138 + 17 + 15";
  EXPECT_NEAR(505, ticksUntilDue(learned(150, 2, 1000), 170, 0), 10);
  // 12 of 18 in 8 ticks.
  EXPECT_EQ(0, ticksUntilDue(learned(150, 2, 8), 162, 0)) << "131 + 16 + 15";
  EXPECT_NEAR(505, ticksUntilDue(learned(150, 2, 8), 163, 0), 10);
}
