// Chain lengths against the judge's exact catenaries, and against geometry worked out by hand.
#include <gtest/gtest.h>
#include <math.h>

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
