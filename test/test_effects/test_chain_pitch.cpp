// Chain pitch: only free chain is scaled, neither the arm nor the chain on the teeth.
#include <Kinematics.h>
#include <gtest/gtest.h>
#include <math.h>

#include "params.h"

using namespace kinematics;

namespace {

const Frame<double> kFrame = {2978.4, 1072.6, 0, 139.1, 10.1063, 97.9, 0.00137293, Feed::kOverTop};

Chains<double> lengths(double left, double right, Point<double> place) {
  const EffectParams<double> effects = withEffects({{180, left}, {181, right}});
  return inverse(prepare(kFrame, effects), place).chains;
}

}  // namespace

TEST(ChainPitch, ScalesFreeChainOnly) {
  const Point<double> place = {400, -200};
  const double distance = hypot(400 + 1489.2, 1072.6 + 200);
  const double free = sqrt(distance * distance - 10.1063 * 10.1063) - 139.1;
  const Chains<double> nominal = lengths(0, 0, place), longer = lengths(0.002, 0, place);
  EXPECT_NEAR(free / 1.002 - free, longer.left - nominal.left, 0.0005);
  EXPECT_EQ(nominal.right, longer.right);
}

TEST(ChainPitch, LeftAndRightMirrorEachOther) {
  const Chains<double> a = lengths(0.001, 0.003, {700, 100});
  const Chains<double> b = lengths(0.003, 0.001, {-700, 100});
  EXPECT_NEAR(a.left, b.right, 1e-9);
  EXPECT_NEAR(a.right, b.left, 1e-9);
}

TEST(ChainPitch, MovesTheSledByThePublishedAmount) {
  // Both chains are 0.1 % long and the machine does not know: independent figures for where the bit
  // lands.
  const EffectParams<double> none = {}, both = withEffects({{180, 0.001}, {181, 0.001}});
  const Chains<double> sent = inverse(prepare(kFrame, none), Point<double>{1150, -550}).chains;
  const Place<double> landed = forward(prepare(kFrame, both), sent);
  EXPECT_NEAR(2.31, landed.sled.x - 1150, 0.15);
  EXPECT_NEAR(-2.16, landed.sled.y + 550, 0.25);
}
