// The residual patch, and what the published settings of chains mean for ours.
#include <gtest/gtest.h>

#include <cmath>

#include "hidden.h"

using namespace kinematics;

namespace {

enum { kLeftX = 210, kLeftY = 211, kLeftXX = 212, kRightX = 219, kRightYyy = 227 };

/// What the patch adds to both chains [mm] at a place.
Chains<double> addedBy(const std::vector<Sized>& sizes, Point<double> place) {
  const Chains<double> with = inverse(lawsWith(sizes), place).chains;
  const Chains<double> without = inverse(lawsWith({}), place).chains;
  return {with.left - without.left, with.right - without.right};
}

}  // namespace

TEST(ResidualPatch, LinearTermsFollowTheSheet) {
  for (int setting : {kLeftX, kRightX}) {
    const bool left = setting == kLeftX;
    auto powers = [&](double x, double y) {
      const Chains<double> added = addedBy({{setting, 1.0}}, {x, y});
      EXPECT_EQ(0.0, left ? added.right : added.left);
      return left ? added.left : added.right;
    };
    // Half a sheet is 0.42 of the motors' distance, 1251 mm.
    EXPECT_NEAR(0.0, powers(0, 0), 0.02);
    EXPECT_NEAR(0.48, powers(600, 0), 0.02);
    EXPECT_NEAR(-0.48, powers(-600, 0), 0.02);
    EXPECT_NEAR(powers(600, 400), powers(600, -400), 0.02);
  }
  EXPECT_NEAR(500 / (0.6 * 1072.6), addedBy({{kLeftY, 1.0}}, {0, 500}).left, 0.02);
}

TEST(ResidualPatch, HigherTermsAreLegendrePolynomials) {
  // P2(0) = -1/2, P2(0.48) = -0.154; P3(0.466) = -0.446.
  EXPECT_NEAR(-0.5, addedBy({{kLeftXX, 1.0}}, {0, 0}).left, 0.01);
  EXPECT_NEAR(-0.154, addedBy({{kLeftXX, 1.0}}, {600, 0}).left, 0.03);
  EXPECT_NEAR(-0.446, addedBy({{kRightYyy, 1.0}}, {0, 300}).right, 0.03);
}

TEST(ResidualPatch, StaysBoundedBeyondTheSheet) {
  std::vector<Sized> all;
  for (int setting = kLeftX; setting <= kRightYyy; ++setting) all.push_back({setting, 1.0});
  for (int x = -1500; x <= 1500; x += 100)
    for (int y = -1500; y <= 800; y += 100) {
      const Point<double> place = {double(x), double(y)};
      if (inverse(lawsWith({}), place).found != Found::kYes) continue;
      const Chains<double> added = addedBy(all, place);
      EXPECT_LE(fabs(added.left), 9.0001) << x << " " << y;
      EXPECT_LE(fabs(added.right), 9.0001) << x << " " << y;
    }
}

namespace {

const PublishedChains<double> kTold = {9e-12, {0.002, -0.001}, 2438.4, 1219.2};

Frame<double> frameWithArm(double arm) {
  Frame<double> frame = frameUnder({});
  frame.rotation_radius = arm;
  return frame;
}

/// Our parameters that the published settings become, where each was 1 before.
EffectParams<double> added(const Frame<double>& frame, const PublishedChains<double>& published) {
  EffectParams<double> effects;
  for (double& value : effects.value) value = 1;
  Effects::For<double>::addPublished(frame, published, effects.value);
  return effects;
}

double of(const EffectParams<double>& effects, int setting) {
  return effects.value[Effects::For<double>::indexOf(setting)];
}

}  // namespace

TEST(PublishedChains, MeanTheSameWithoutAnArm) {
  const EffectParams<double> ours = added(frameWithArm(0), kTold);
  EXPECT_NEAR(of(ours, 160) - 1, 9e-12, 1e-15);
  EXPECT_NEAR(of(ours, 180), 1.002, 1e-12);
  EXPECT_NEAR(of(ours, 181), 0.999, 1e-12);
  EXPECT_NEAR(of(ours, 200), 1, 1e-12);
  EXPECT_NEAR(of(ours, 201), 1, 1e-12);
}

TEST(PublishedChains, TreatTheArmAsChain) {
  const double arm = 250;
  const Frame<double> frame = frameWithArm(arm);
  const EffectParams<double> ours = added(frame, kTold);
  // If the arm were divided by 1 + strain like a chain, it would be this much shorter.
  EXPECT_NEAR(of(ours, 200) - 1, arm - arm / 1.002, 1e-9);
  EXPECT_NEAR(of(ours, 201) - 1, arm - arm / 0.999, 1e-9);
  // The published sag grows with the third power of the whole line. Ours grows with that of the
  // chain, times 1 + 3 times the arm's share. Both are the same at the longest line.
  const double line = std::hypot((frame.motor_gap + 2438.4) / 2, frame.motor_height + 1219.2 / 2);
  const double chain = line - arm;
  const double published = 9e-12 * line * line * line;
  const double same = (of(ours, 160) - 1) * chain * chain * chain * (1 + 3 * arm / line);
  EXPECT_NEAR(same / published, 1, 1e-4);
}

TEST(PublishedChains, AddNothingWhenZero) {
  const EffectParams<double> ours = added(frameWithArm(250), {0, {0, 0}, 2438.4, 1219.2});
  for (const double value : ours.value) EXPECT_EQ(1, value);
}
