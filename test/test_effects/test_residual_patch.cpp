// The residual patch: its terms on the sheet, and that it stays bounded beyond.
#include <gtest/gtest.h>

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
