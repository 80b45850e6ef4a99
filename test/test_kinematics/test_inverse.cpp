// Chain lengths against the judge's exact catenaries, and the search for the sled's place from
// anywhere.
#include <gtest/gtest.h>
#include <math.h>

#include <random>

#include "machines.h"

using namespace kinematics;

class EveryMachine : public testing::TestWithParam<Tried> {};
INSTANTIATE_TEST_SUITE_P(Inverse, EveryMachine, testing::ValuesIn(triedMachines()), NameOfTried());

namespace {

/// Worst difference [mm] of either chain's length from the judge's, over sheet and border.
double worstAgainstJudge(const Tried& tried) {
  const Machine<double> machine = lawsOf<double>(tried);
  const reference::Machine judge = judgeOf(tried);
  double worst = 0;
  for (const Point<double>& place : sheetPlaces<double>()) {
    const PaidOut<double> paid = inverse(machine, place);
    const reference::Hang truth = reference::hangAt(judge, {place.x, place.y});
    EXPECT_TRUE(truth.solved);
    EXPECT_EQ(Found::kYes, paid.found);
    worst = fmax(worst, fabs(paid.chains.left - truth.paid_out[0]));
    worst = fmax(worst, fabs(paid.chains.right - truth.paid_out[1]));
  }
  return worst;
}

}  // namespace

TEST_P(EveryMachine, LengthsAgreeWithExactStatics) {
  EXPECT_LT(worstAgainstJudge(GetParam()), 0.01);
}

TEST(Inverse, IsExactOnBothSidesOfEveryDeepLimit) {
  // The second order of sag is left out where it is not needed: that must not show anywhere.
  for (double ring : {120.5, 159.5, 119.5, 160.5})
    for (double sled : {94.5, 95.0}) {
      Tried tried;
      tried.name = "AtTheLimit";
      tried.rotation_radius = ring;
      tried.sled_weight = sled;
      EXPECT_LT(worstAgainstJudge(tried), 0.008) << "ring " << ring << " sled " << sled;
    }
}

TEST_P(EveryMachine, FloatAgreesWithDouble) {
  const Machine<float> single = lawsOf<float>(GetParam());
  const Machine<double> twice = lawsOf<double>(GetParam());
  for (const Point<float>& place : sheetPlaces<float>()) {
    const PaidOut<float> rounded = inverse(single, place);
    const PaidOut<double> exact = inverse(twice, Point<double>{place.x, place.y});
    ASSERT_EQ(Found::kYes, rounded.found);
    EXPECT_NEAR(exact.chains.left, double(rounded.chains.left), 0.0012);
    EXPECT_NEAR(exact.chains.right, double(rounded.chains.right), 0.0012);
  }
}

TEST(Inverse, StepsSmoothlyInFloat) {
  // Along a slow cut the length of each step must not jitter by a tenth of an encoder count.
  const Machine<float> single = lawsOf<float>(triedMachines()[0]);
  const Machine<double> twice = lawsOf<double>(triedMachines()[0]);
  double worst = 0;
  float before = 0;
  double exact_before = 0;
  for (int i = 0; i < 4000; ++i) {
    const Point<float> place = {-300 + 0.15f * float(i), -500 + 0.01f * float(i)};
    const float now = inverse(single, place).chains.left;
    const double exact = inverse(twice, Point<double>{place.x, place.y}).chains.left;
    if (i > 0) worst = fmax(worst, fabs(double(now - before) - (exact - exact_before)));
    before = now;
    exact_before = exact;
  }
  EXPECT_LT(worst, 0.0015);
}

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

TEST(Forward, FollowsASmallStepInOneIteration) {
  const Machine<float> machine = lawsOf<float>(triedMachines()[0]);
  const Point<float> target = {250, -120}, guess = {250.05f, -120.03f};
  const Place<float> place = forward(machine, inverse(machine, target).chains, guess);
  EXPECT_EQ(1, place.tries);
  EXPECT_LT(miss(place, target), kCloseEnough);
}

namespace {

const float kNan = nanf("");

Machine<float> machine() { return lawsOf<float>(triedMachines()[0]); }

Found foundAt(float x, float y) {
  const PaidOut<float> paid = inverse(machine(), Point<float>{x, y});
  if (paid.found != Found::kYes) {
    EXPECT_EQ(0, paid.chains.left);
    EXPECT_EQ(0, paid.chains.right);
  }
  return paid.found;
}

Found foundFor(float left, float right) {
  const Place<float> place = forward(machine(), Chains<float>{left, right});
  return place.found;
}

}  // namespace

TEST(BadInput, PlacesThatAreNaN) {
  EXPECT_EQ(Found::kOutOfReach, foundAt(kNan, 0));
  EXPECT_EQ(Found::kOutOfReach, foundAt(0, kNan));
  EXPECT_EQ(Found::kOutOfReach, foundAt(kNan, kNan));
  EXPECT_EQ(Found::kOutOfReach, foundAt(INFINITY, 0));
  EXPECT_EQ(Found::kOutOfReach, foundAt(0, -INFINITY));
  EXPECT_EQ(Found::kOutOfReach, foundAt(1e30f, -1e30f));
}

TEST(BadInput, PlacesAboveOrBesideTheMotors) {
  EXPECT_EQ(Found::kOutOfReach, foundAt(0, 1072.6f));
  EXPECT_EQ(Found::kOutOfReach, foundAt(0, 1500));
  EXPECT_EQ(Found::kOutOfReach, foundAt(300, 1080));
  EXPECT_EQ(Found::kOutOfReach, foundAt(1600, 0));
  EXPECT_EQ(Found::kOutOfReach, foundAt(-1600, -500));
}

TEST(BadInput, PlacesInsideASprocketOrItsRing) {
  EXPECT_EQ(Found::kOutOfReach, foundAt(-1489.2f, 1072.6f));
  EXPECT_EQ(Found::kOutOfReach, foundAt(1489.2f, 1072.6f));
  EXPECT_EQ(Found::kOutOfReach, foundAt(-1485.2f, 1066.6f));
  EXPECT_EQ(Found::kOutOfReach, foundAt(-1400, 1000));  // nearer than the ring is wide
}

TEST(BadInput, WithoutARingTheBitStaysOutOfTheSprocket) {
  Tried tried;
  tried.rotation_radius = 0;
  const Machine<float> bare = lawsOf<float>(tried);
  EXPECT_EQ(Found::kOutOfReach, inverse(bare, Point<float>{-1484.2f, 1065.6f}).found);
}

TEST(BadInput, LengthsThatAreNaN) {
  EXPECT_EQ(Found::kOutOfReach, foundFor(kNan, 1500));
  EXPECT_EQ(Found::kOutOfReach, foundFor(1500, kNan));
  EXPECT_EQ(Found::kOutOfReach, foundFor(INFINITY, 1500));
  EXPECT_EQ(Found::kOutOfReach, foundFor(1e30f, 1e30f));
}

TEST(BadInput, ANaNAsAGuessDoesNotSpoilTheSearch) {
  const Chains<float> chains = inverse(machine(), Point<float>{200, -300}).chains;
  const Place<float> place = forward(machine(), chains, Point<float>{kNan, INFINITY});
  ASSERT_EQ(Found::kYes, place.found);
  EXPECT_NEAR(200, place.sled.x, 0.01);
  EXPECT_NEAR(-300, place.sled.y, 0.01);
}

TEST(BadInput, FoundPlacesGiveBackTheirChains) {
  // Any pair of lengths is either refused, or gives a place that needs exactly these lengths.
  const Machine<float> here = machine();
  int found = 0, refused = 0;
  for (float left = 0; left < 5000; left += 83)
    for (float right = 0; right < 5000; right += 83) {
      const Place<float> place = forward(here, Chains<float>{left, right});
      if (place.found != Found::kYes) {
        ++refused;
        continue;
      }
      ++found;
      const PaidOut<float> back = inverse(here, place.sled);
      ASSERT_EQ(Found::kYes, back.found) << left << " " << right;
      EXPECT_NEAR(left, back.chains.left, 0.1) << left << " " << right;
      EXPECT_NEAR(right, back.chains.right, 0.1) << left << " " << right;
    }
  EXPECT_GT(found, 500);
  EXPECT_GT(refused, 500);
}

TEST(BadInput, PlacesAlmostUnderAMotor) {
  for (double gap = 2400; gap < 2480; gap += 4) {
    Tried narrow = triedMachines()[0];
    narrow.motor_gap = gap;
    const Machine<float> laws = lawsOf<float>(narrow);
    for (float x = 1150; x < 1240; x += 0.25f)
      for (const float y : {-600.0f, 0.0f, 600.0f}) {
        const PaidOut<float> paid = inverse(laws, Point<float>{x, y});
        if (paid.found != Found::kYes) continue;
        const float straight = hypotf(x + float(gap) / 2, laws.frame.motor_height - y);
        EXPECT_NEAR(straight, paid.chains.left, 400) << gap << " " << x << " " << y;
      }
  }
}
