// The search for the sled's place: from anywhere it comes back to the place given to inverse.
#include <gtest/gtest.h>
#include <math.h>

#include <random>

#include "machines.h"

using namespace kinematics;

class FromAnywhere : public testing::TestWithParam<Tried> {};
INSTANTIATE_TEST_SUITE_P(Forward, FromAnywhere, testing::ValuesIn(triedMachines()), NameOfTried());

namespace {

template <class Real>
double miss(const Place<Real>& place, Point<Real> target) {
  return hypot(double(place.sled.x - target.x), double(place.sled.y - target.y));
}

}  // namespace

TEST_P(FromAnywhere, NoGuess) {
  const Machine<float> machine = lawsOf<float>(GetParam());
  for (const Point<float>& target : sheetPlaces<float>()) {
    const Place<float> place = forward(machine, inverse(machine, target).chains);
    ASSERT_EQ(Found::kYes, place.found) << target.x << " " << target.y;
    EXPECT_LT(miss(place, target), kCloseEnough) << target.x << " " << target.y;
    EXPECT_LE(place.tries, 5);
  }
}

TEST_P(FromAnywhere, GuessInTheFarCorner) {
  const Machine<float> machine = lawsOf<float>(GetParam());
  for (const Point<float>& target : sheetPlaces<float>()) {
    const Point<float> far = {target.x > 0 ? -1229.2f : 1229.2f, target.y > 0 ? -619.6f : 619.6f};
    const Place<float> place = forward(machine, inverse(machine, target).chains, far);
    ASSERT_EQ(Found::kYes, place.found) << target.x << " " << target.y;
    EXPECT_LT(miss(place, target), kCloseEnough) << target.x << " " << target.y;
  }
}

TEST_P(FromAnywhere, GuessInTwiceTheSheet) {
  const Machine<float> machine = lawsOf<float>(GetParam());
  std::mt19937 random(20200501);
  std::uniform_real_distribution<float> across(-2438.4f, 2438.4f), along(-1219.2f, 1219.2f);
  for (const Point<float>& target : sheetPlaces<float>(10, 17, 9)) {
    for (int i = 0; i < 10; ++i) {
      const Point<float> guess = {across(random), along(random)};
      const Place<float> place = forward(machine, inverse(machine, target).chains, guess);
      ASSERT_EQ(Found::kYes, place.found) << "from " << guess.x << " " << guess.y;
      EXPECT_LT(miss(place, target), kCloseEnough) << "from " << guess.x << " " << guess.y;
    }
  }
}

TEST_P(FromAnywhere, FindsThePlaceThatTheJudgeFinds) {
  const Machine<double> machine = lawsOf<double>(GetParam());
  const reference::Machine judge = judgeOf(GetParam());
  for (const Point<double>& target : sheetPlaces<double>(0, 9, 5)) {
    const reference::Hang truth = reference::hangAt(judge, {target.x, target.y});
    const Place<double> place =
        forward(machine, Chains<double>{truth.paid_out[0], truth.paid_out[1]});
    ASSERT_EQ(Found::kYes, place.found);
    EXPECT_LT(miss(place, target), 0.05);
  }
}

TEST(Forward, FollowsASmallStepInOneIteration) {
  const Machine<float> machine = lawsOf<float>(triedMachines()[0]);
  const Point<float> target = {250, -120}, guess = {250.05f, -120.03f};
  const Place<float> place = forward(machine, inverse(machine, target).chains, guess);
  EXPECT_EQ(1, place.tries);
  EXPECT_LT(miss(place, target), kCloseEnough);
}
