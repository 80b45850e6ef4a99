// Where a chain comes to rest: how far it passes its goal, and strays on its way there.
#include <gtest/gtest.h>

#include <algorithm>

#include "axis.h"

namespace {

/// Results of forty motors, each in both directions, sorted by size.
struct Ends {
  std::vector<double> beyond;  ///< [mm] largest distance past the goal
  std::vector<double> strays;  ///< [mm] RMS distance from the set-point during the move
};

/// A move of 20 mm and a second of rest.
void travel(unsigned seed, double rate, double feed, double goal, Ends& ends) {
  ControlledAxis axis(seed, rate);
  ToAndFro way(feed, axis.seconds);
  double beyond = 0, squares = 0;
  int moving = 0;
  for (int rest = 0; rest < int(rate);) {
    const Asked asked = way.towards(goal);
    const double error = axis.tick(asked);
    if (way.isAt(goal)) {
      ++rest;
      beyond = std::max(beyond, goal > 0 ? -error : error);
    } else {
      squares += error * error;
      ++moving;
    }
  }
  ends.beyond.push_back(beyond);
  ends.strays.push_back(std::sqrt(squares / moving));
}

Ends endsOf(double rate, double feed) {
  Ends ends;
  for (unsigned seed = 0; seed < kMotors; ++seed)
    for (const double goal : {20.0, -20.0}) travel(seed, rate, feed, goal, ends);
  std::sort(ends.beyond.begin(), ends.beyond.end());
  std::sort(ends.strays.begin(), ends.strays.end());
  return ends;
}

class Ending : public testing::TestWithParam<double> {};

}  // namespace

INSTANTIATE_TEST_SUITE_P(Both, Ending, testing::Values(100.0, 200.0));

TEST_P(Ending, PassesItsGoalAndStraysByLittleAtEverySpeed) {
  for (const double feed : {300.0, 600.0, 800.0, 1000.0, 1200.0}) {
    const Ends ends = endsOf(GetParam(), feed);
    printf("%3.0f Hz %4.0f mm/min: past the goal %.3f, worst %.3f mm; strays %.3f, worst %.3f\n",
           GetParam(), feed, ends.beyond[kMotors], ends.beyond.back(), ends.strays[kMotors],
           ends.strays.back());
    EXPECT_LT(ends.beyond[kMotors], 0.06) << feed;
    if (feed <= 800) {
      EXPECT_LT(ends.beyond.back(), 0.08) << feed;
    }
  }
}
