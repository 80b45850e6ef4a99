// What the published settings of chains mean for ours: sag, and links that are longer than nominal.
#include <gtest/gtest.h>

#include <cmath>

#include "hidden.h"

using namespace kinematics;

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
