// The search for a root where plain Newton would run away, and where there is none.
#include <gtest/gtest.h>

#include "reference/newton.h"

namespace {

using Vector = Eigen::Vector2d;

TEST(Newton, HalvesAStepThatOvershoots) {
  // From 3, whole steps on an arc tangent grow without end.
  const auto defect = [](const Vector& at) -> Vector { return {std::atan(at[0]), at[1] - at[0]}; };
  const reference::Root<2> root = reference::findRoot<2>(defect, Vector(3, 1));
  ASSERT_TRUE(root.found);
  EXPECT_NEAR(0, root.at[0], 1e-12);
  EXPECT_NEAR(0, root.at[1], 1e-12);
}

TEST(Newton, ReportsAMissingRoot) {
  const auto defect = [](const Vector& at) -> Vector { return {at[0] * at[0] + 1, at[1]}; };
  EXPECT_FALSE(reference::findRoot<2>(defect, Vector(3, 1)).found);
}

TEST(Newton, DoesNotTakeNaNForARoot) {
  const auto defect = [](const Vector& at) -> Vector { return {std::sqrt(at[0]), at[1]}; };
  EXPECT_FALSE(reference::findRoot<2>(defect, Vector(-1, 0)).found);
}

}  // namespace
