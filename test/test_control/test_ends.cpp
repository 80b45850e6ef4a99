// Where a chain comes to rest: how far it passes its goal, compared with the published law.
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
template <class Loop>
void travel(unsigned seed, double rate, double feed, double goal, Ends& ends) {
  AxisWith<Loop> axis(seed, rate);
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

template <class Loop>
Ends endsOf(double rate, double feed) {
  Ends ends;
  for (unsigned seed = 0; seed < kMotors; ++seed)
    for (const double goal : {20.0, -20.0}) travel<Loop>(seed, rate, feed, goal, ends);
  std::sort(ends.beyond.begin(), ends.beyond.end());
  std::sort(ends.strays.begin(), ends.strays.end());
  return ends;
}

void print(const char* law, double rate, double feed, const Ends& ends) {
  printf("%-9s %3.0f Hz %4.0f mm/min: past the goal %.3f, worst %.3f mm; strays %.3f, worst %.3f\n",
         law, rate, feed, ends.beyond[kMotors], ends.beyond.back(), ends.strays[kMotors],
         ends.strays.back());
}

class Ending : public testing::TestWithParam<double> {};

}  // namespace

INSTANTIATE_TEST_SUITE_P(Both, Ending, testing::Values(100.0, 200.0));

TEST_P(Ending, PassesItsGoalByLessThanThePublishedLawAtEverySpeed) {
  for (const double feed : {300.0, 600.0, 800.0, 1000.0, 1200.0}) {
    const Ends ours = endsOf<motion::AxisLoop>(GetParam(), feed);
    const Ends published = endsOf<PublishedLoop>(GetParam(), feed);
    print("this", GetParam(), feed, ours);
    print("published", GetParam(), feed, published);
    EXPECT_LT(ours.beyond[kMotors], published.beyond[kMotors]) << feed;
    EXPECT_LT(ours.beyond.back(), published.beyond.back()) << feed;
    EXPECT_LT(ours.strays[kMotors], published.strays[kMotors]) << feed;
    EXPECT_LT(ours.strays.back(), published.strays.back()) << feed;
    EXPECT_LT(ours.beyond[kMotors], 0.06) << feed;
    if (feed <= 800) {
      EXPECT_LT(ours.beyond.back(), 0.08) << feed;
    }
  }
}
