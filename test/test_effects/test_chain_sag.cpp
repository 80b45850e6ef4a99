// Chain sag against a figure from outside and against the judge's catenary.
#include <Kinematics.h>
#include <gtest/gtest.h>
#include <math.h>

#include "hidden.h"

using namespace kinematics;

namespace {

Machine<double> sagging(double weight_ratio_squared, double rotation_radius, double gap) {
  const Frame<double> frame = {
      gap, 1072.6, 0, rotation_radius, 10.10634, kSledWeight, kChainWeight, Feed::kOverTop};
  const EffectParams<double> effects = withEffects({{160, weight_ratio_squared}});
  return prepare(frame, effects);
}

}  // namespace

TEST(ChainSag, PublishedCorrectionMeansTheRatioOfTheWeights) {
  // 0.14 kg/m of chain under 97.9 N is the published setting 8.2 (times 1e-12 / mm^2).
  const double ratio = kChainWeight / kSledWeight;
  EXPECT_NEAR(8.2, 1e12 * ratio * ratio / 24, 0.05);
}

TEST(ChainSag, AddsWhatExactCatenariesAdd) {
  const double ratio = kChainWeight / kSledWeight;
  for (double radius : {0.0, 139.1}) {
    const Machine<double> machine = sagging(ratio * ratio / 24, radius, 2978.4);
    const Machine<double> straight = sagging(0, radius, 2978.4);
    reference::Machine judge;
    judge.rotation_radius = radius;
    judge.sprocket_radius = 10.10634;
    judge.left.weight = judge.right.weight = kChainWeight;
    const Point<double> corner = {1150, -550};
    const double extra =
        inverse(machine, corner).chains.left - inverse(straight, corner).chains.left;
    const double exact =
        reference::hangAt(judge, {1150, -550}).paid_out[0] - inverse(straight, corner).chains.left;
    EXPECT_NEAR(exact, extra, radius > 0 ? 0.004 : 0.012);
    EXPECT_GT(extra, 3);
  }
}

TEST(ChainSag, IsSymmetric) {
  const Machine<double> machine = sagging(8.2e-12, 139.1, 2978.4);
  const Chains<double> a = inverse(machine, Point<double>{900, -400}).chains;
  const Chains<double> b = inverse(machine, Point<double>{-900, -400}).chains;
  EXPECT_NEAR(a.left, b.right, 1e-9);
  EXPECT_NEAR(a.right, b.left, 1e-9);
}
