// Where a chain comes to rest: how far it passes its goal.
#include <gtest/gtest.h>

#include <algorithm>

#include "axis.h"

namespace {

/// [mm] Largest distance past the goal of a move of 20 mm, with a second of rest.
double beyond(unsigned seed, double rate, double feed, double goal) {
  ControlledAxis axis(seed, rate);
  ToAndFro way(feed, axis.seconds);
  double most = 0;
  for (int rest = 0; rest < int(rate);) {
    const double error = axis.tick(way.towards(goal));
    if (!way.isAt(goal)) continue;
    ++rest;
    most = std::max(most, goal > 0 ? -error : error);
  }
  return most;
}

/// That of forty motors, each in both directions, sorted.
std::vector<double> beyondOf(double rate, double feed) {
  std::vector<double> all;
  for (unsigned seed = 0; seed < kMotors; ++seed)
    for (const double goal : {20.0, -20.0}) all.push_back(beyond(seed, rate, feed, goal));
  std::sort(all.begin(), all.end());
  return all;
}

class Ending : public testing::TestWithParam<double> {};

}  // namespace

INSTANTIATE_TEST_SUITE_P(Both, Ending, testing::Values(100.0, 200.0));

TEST_P(Ending, OvershootsLittleAtEverySpeed) {
  for (const double feed : {300.0, 600.0, 800.0, 1000.0, 1200.0}) {
    const std::vector<double> past = beyondOf(GetParam(), feed);
    printf("%3.0f Hz %4.0f mm/min: past the goal %.3f, worst %.3f mm\n", GetParam(), feed,
           past[kMotors], past.back());
    EXPECT_LT(past[kMotors], 0.06) << feed;
    if (feed <= 800) {
      EXPECT_LT(past.back(), 0.08) << feed;
    }
  }
}
