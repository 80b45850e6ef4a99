// Where a place is usable: tensions and give against the judge, published figures, and verdicts.
#include <gtest/gtest.h>
#include <math.h>

#include <limits>

#include "machines.h"
#include "reach.h"

using namespace kinematics;

class ReachOf : public testing::TestWithParam<Tried> {};
INSTANTIATE_TEST_SUITE_P(Reach, ReachOf, testing::ValuesIn(triedMachines()), NameOfTried());

namespace {

/// What the judge's sled really does when it is pushed [mm/N]; a column for each direction.
Eigen::Matrix2d pushed(reference::Machine machine, Point<double> place) {
  const double push = 0.2;  // [N]
  const reference::Hang rest = reference::hangAt(machine, {place.x, place.y});
  EXPECT_TRUE(rest.solved) << place.x << " " << place.y;
  Eigen::Matrix2d give;
  for (int axis = 0; axis < 2; ++axis) {
    machine.push = push * Eigen::Vector2d::Unit(axis);
    const reference::Hang there = reference::settleFrom(machine, rest, rest.paid_out);
    machine.push = -machine.push;
    const reference::Hang back = reference::settleFrom(machine, rest, rest.paid_out);
    EXPECT_TRUE(there.solved && back.solved) << place.x << " " << place.y;
    give.col(axis) = (there.bit - back.bit) / (2 * push);
  }
  return give;
}

template <class Real>
Reached<Real> reachedBy(const Machine<Real>& machine, Point<Real> place) {
  return reach(machine, place, ReachLimits<Real>());
}

/// Worst error of the give over the sheet, as a share: of each diagonal term, and for the mixed
/// term of their geometric mean.
double worstGive(const Machine<double>& machine, const reference::Machine& judge) {
  double worst = 0;
  for (const Point<double>& place : sheetPlaces<double>(0, 13, 7)) {
    const Eigen::Matrix2d truth = pushed(judge, place);
    const Give<double> give = reachedBy(machine, place).give;
    worst = fmax(worst, fabs(give.xx / truth(0, 0) - 1));
    worst = fmax(worst, fabs(give.yy / truth(1, 1) - 1));
    const double mean = sqrt(truth(0, 0) * truth(1, 1));
    worst = fmax(worst, fabs(give.xy - truth(0, 1)) / mean);
    worst = fmax(worst, fabs(give.xy - truth(1, 0)) / mean);
  }
  return worst;
}

/// The default machine with these effects alone, in the form of lib/Kinematics.
Machine<double> lawsWith(std::initializer_list<std::pair<int, double>> sizes) {
  const Frame<double> frame = lawsOf<double>(triedMachines()[0]).frame;
  EffectParams<double> effects = {};
  for (const auto& sized : sizes) EXPECT_TRUE(effects.set(sized.first, sized.second));
  return prepare(frame, effects);
}

double sagOf(const Tried& tried) {
  const double ratio = tried.chain_weight / tried.sled_weight;
  return ratio * ratio / 24;
}

Reach verdictAt(double x, double y, const ReachLimits<double>& limits = ReachLimits<double>()) {
  return reach(lawsOf<double>(triedMachines()[0]), Point<double>{x, y}, limits).verdict;
}

}  // namespace

TEST_P(ReachOf, GiveAgreesWithTheJudge) {
  EXPECT_LT(worstGive(lawsOf<double>(GetParam()), judgeOf(GetParam())), 0.018);
}

TEST(Reach, EveryEffectWithForceGives) {
  // With this effect alone, in lib/Kinematics and in the judge. A rigid chain without weight does
  // not give.
  const Tried tried = triedMachines()[0];
  Tried stiff = tried;
  stiff.compliance = stiff.left_pitch = stiff.right_pitch = 0;
  reference::Machine judge = judgeOf(stiff);
  EXPECT_LT(worstGive(lawsWith({{160, sagOf(tried)}}), judge), 0.015) << "chain_sag";
  judge.left.compliance = judge.right.compliance = 8e-6;
  EXPECT_LT(worstGive(lawsWith({{160, sagOf(tried)}, {170, 8e-6}}), judge), 0.015) << "stretch";
  judge.left.inward = judge.right.inward = 0.02;
  judge.left.downward = judge.right.downward = 0.03;
  EXPECT_LT(
      worstGive(lawsWith({{160, sagOf(tried)}, {170, 8e-6}, {110, 0.02}, {111, 0.03}}), judge),
      0.015)
      << "frame_flex";
}

TEST(Reach, ALeaningFrameIsSofter) {
  // The parts of the weights along the sheet stay, so the full weights grow.
  const Tried tried = triedMachines()[0];
  Tried whole = tried;
  const double lean = 0.26;
  whole.sled_weight /= cos(lean);
  whole.chain_weight /= cos(lean);
  whole.left_pitch = whole.right_pitch = 0;
  reference::Machine judge = judgeOf(whole);
  judge.lean = lean;
  const double tangent_squared = tan(lean) * tan(lean);
  const Machine<double> leaning =
      lawsWith({{150, tangent_squared}, {160, sagOf(tried)}, {170, tried.compliance}});
  const Machine<double> upright = lawsWith({{160, sagOf(tried)}, {170, tried.compliance}});
  EXPECT_LT(worstGive(leaning, judge), 0.015);
  EXPECT_GT(worstGive(upright, judge), 0.03);
}

TEST_P(ReachOf, TensionsAtTheSprocketsAgreeWithTheJudge) {
  const Machine<double> machine = lawsOf<double>(GetParam());
  const reference::Machine judge = judgeOf(GetParam());
  for (const Point<double>& place : sheetPlaces<double>(0, 13, 7)) {
    const reference::Hang truth = reference::hangAt(judge, {place.x, place.y});
    const Reached<double> here = reachedBy(machine, place);
    EXPECT_NEAR(1, here.tension[kLeft] / truth.left.tension_at_sprocket, 0.022);
    EXPECT_NEAR(1, here.tension[kRight] / truth.right.tension_at_sprocket, 0.022);
  }
}

TEST_P(ReachOf, FloatAgreesWithDouble) {
  const Machine<float> single = lawsOf<float>(GetParam());
  const Machine<double> twice = lawsOf<double>(GetParam());
  for (const Point<float>& place : sheetPlaces<float>(0, 13, 7)) {
    const Reached<float> rounded = reachedBy(single, place);
    const Reached<double> exact = reachedBy(twice, Point<double>{place.x, place.y});
    EXPECT_EQ(exact.verdict, rounded.verdict) << place.x << " " << place.y;
    EXPECT_NEAR(exact.give.xx, double(rounded.give.xx), 0.005 * exact.give.xx);
    EXPECT_NEAR(exact.give.yy, double(rounded.give.yy), 0.005 * exact.give.yy);
    EXPECT_NEAR(exact.tension[kLeft], double(rounded.tension[kLeft]), 0.001);
  }
}

TEST(Reach, AMachineWithoutForceEffectsDoesNotGiveButStillPulls) {
  const Machine<double> rigid = lawsWith({{180, 0.002}, {100, 3}});
  const Reached<double> here = reachedBy(rigid, Point<double>{1150, -550});
  EXPECT_EQ(0, here.give.xx);
  EXPECT_EQ(0, here.give.xy);
  EXPECT_EQ(0, here.give.yy);
  EXPECT_GT(here.tension[kRight], 85);
  EXPECT_EQ(Reach::kTooSlack, reachedBy(rigid, Point<double>{1219.2, -609.6}).verdict);
}

class EachLimit : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Reach, EachLimit, testing::Values(-1000, 1000),
                         [](const testing::TestParamInfo<double>& tested) {
                           return tested.param < 0 ? "LeftOfTheMiddle" : "RightOfTheMiddle";
                         });

TEST_P(EachLimit, IsTestedAtItsExactValue) {
  const Point<double> place = {GetParam(), -400};
  const Reached<double> here = reachedBy(lawsOf<double>(triedMachines()[0]), place);
  const uint8_t near = place.x < 0 ? kLeft : kRight;
  ASSERT_EQ(Reach::kUsable, here.verdict);
  for (double share : {0.999, 1.001}) {
    const bool within = share > 1;
    ReachLimits<double> limits;
    limits.most_tension = here.tension[near] * share;
    EXPECT_EQ(within ? Reach::kUsable : Reach::kTooTight, verdictAt(place.x, place.y, limits));
    limits = ReachLimits<double>();
    limits.least_tension = here.tension[1 - near] / share;
    EXPECT_EQ(within ? Reach::kUsable : Reach::kTooSlack, verdictAt(place.x, place.y, limits));
    limits = ReachLimits<double>();
    limits.most_give = mostGive(here.give) * share;
    EXPECT_EQ(within ? Reach::kUsable : Reach::kTooVertical, verdictAt(place.x, place.y, limits));
  }
}

TEST(Reach, TheFirstReasonIsGiven) {
  ReachLimits<double> strict;
  strict.most_give = 0;
  EXPECT_EQ(Reach::kTooVertical, verdictAt(0, 0, strict));
  strict.least_tension = 1000;
  EXPECT_EQ(Reach::kTooSlack, verdictAt(0, 0, strict));
  strict.most_tension = 10;
  EXPECT_EQ(Reach::kTooTight, verdictAt(0, 0, strict));
  strict.least_free = 5000;
  EXPECT_EQ(Reach::kCannotHang, verdictAt(0, 0, strict));
}

TEST(Reach, OnTheDefaultMachineOnlyTheLowerCornersAreUnusable) {
  const Machine<double> machine = lawsOf<double>(triedMachines()[0]);
  for (const Point<double>& place : sheetPlaces<double>(0, 49, 25)) {
    if (fabs(place.x) > 1190 && place.y < -400) continue;
    EXPECT_EQ(Reach::kUsable, reachedBy(machine, place).verdict) << place.x << " " << place.y;
  }
  EXPECT_EQ(Reach::kTooSlack, verdictAt(1219.2, -609.6));
  EXPECT_EQ(Reach::kTooVertical, verdictAt(-1200, -600));
}

TEST(Reach, MostGiveIsTheLargerEigenvalue) {
  EXPECT_DOUBLE_EQ(4, mostGive(Give<double>{1, 0, 4}));
  EXPECT_DOUBLE_EQ(4, mostGive(Give<double>{4, 0, 1}));
  EXPECT_DOUBLE_EQ(3, mostGive(Give<double>{2, -1, 2}));
  EXPECT_FLOAT_EQ(6, mostGive(Give<float>{2, 2, 5}));
}

TEST(Reach, GiveAndTensionAreZeroWhereNoSledCanHang) {
  const Machine<float> machine = lawsOf<float>(triedMachines()[0]);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  const Point<float> nowhere[] = {{nan, 0},     {0, nan},     {inf, 0},        {0, -inf},
                                  {0, inf},     {0, 1072.6f}, {0, 1500},       {1600, 0},
                                  {-1600, -50}, {1400, 1000}, {1e30f, -1e30f}, {0, -1e30f}};
  for (const Point<float>& place : nowhere) {
    const Reached<float> here = reachedBy(machine, place);
    EXPECT_EQ(Reach::kCannotHang, here.verdict) << place.x << " " << place.y;
    EXPECT_EQ(0, here.tension[kLeft]);
    EXPECT_EQ(0, here.tension[kRight]);
    EXPECT_EQ(0, here.give.xx);
    EXPECT_EQ(0, here.give.xy);
    EXPECT_EQ(0, here.give.yy);
  }
}

TEST(Reach, TheRingMustNotTouchASprocket) {
  // 159 mm inwards of the sprocket, 180 below: 240.2 to the bit, 240.0 of tangent, 139.1 of arm.
  for (double side : {-1, 1}) {
    EXPECT_NE(Reach::kCannotHang, verdictAt(side * (1489.2 - 159), 1072.6 - 180));
    EXPECT_EQ(Reach::kCannotHang, verdictAt(side * (1489.2 - 157), 1072.6 - 180));
  }
}
