// Chain stretch against statics worked out by hand.
#include <Kinematics.h>
#include <gtest/gtest.h>
#include <math.h>

#include "params.h"

using namespace kinematics;

TEST(ChainStretch, ShortensTheLinksByTheirLoad) {
  // A 3-4-5 triangle: both strands 500 long and inclined by atan(3/4), so each carries
  // W / (2 * 0.6) of a weightless chain's load.
  const Frame<double> frame = {800, 300, 0, 0, 1e-6, 120, 0, Feed::kOverTop};
  const EffectParams<double> stretched = withEffects({{170, 1e-5}});
  const EffectParams<double> rigid = {};
  const Point<double> middle = {0, 0};
  const double change = inverse(prepare(frame, stretched), middle).chains.left -
                        inverse(prepare(frame, rigid), middle).chains.left;
  EXPECT_NEAR(-500 * 1e-5 * 100, change, 0.0006);
}

TEST(ChainStretch, DropsTheTopCentreByThePublishedAmount) {
  // 5.17e-6 per newton under 97.9 N: a machine that does not know of it leaves the top centre
  // 3.48 mm low (independent calculation with straight chains).
  const Frame<double> frame = {2978.4, 1072.6, 0, 139.1, 10.1063, 97.9, 0.00137293, Feed::kOverTop};
  const EffectParams<double> rigid = {}, elastic = withEffects({{170, 5.17e-6}});
  const Chains<double> sent = inverse(prepare(frame, rigid), Point<double>{0, 550}).chains;
  const Place<double> landed = forward(prepare(frame, elastic), sent);
  ASSERT_EQ(Found::kYes, landed.found);
  // In that calculation the chain stretches along the ring too.
  EXPECT_NEAR(-3.48, landed.sled.y - 550, 0.35);
  EXPECT_NEAR(0, landed.sled.x, 0.001);
}
