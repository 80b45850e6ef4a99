// Centres of arcs given by their radius: both signs, half circles, and refusals.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "reading.h"

using namespace gcode;

namespace {

/// Angle [rad] that an arc turns about its centre, positive.
double sweep(double dx, double dy, ArcCentre centre, bool clockwise) {
  const double start = std::atan2(-double(centre.y), -double(centre.x));
  const double end = std::atan2(dy - double(centre.y), dx - double(centre.x));
  const double turned = clockwise ? start - end : end - start;
  return turned <= 0 ? turned + 2 * M_PI : turned;
}

}  // namespace

TEST(ArcCentre, IsEquidistantAndGivesTheShortArcUnlessRIsNegative) {
  std::mt19937 random(4);
  std::uniform_real_distribution<float> place(-900, 900), factor(0.501f, 20);
  for (int i = 0; i < 100000; ++i) {
    const float dx = place(random), dy = place(random);
    const float wide = factor(random) * std::hypot(dx, dy);
    const bool clockwise = i & 1, is_long = i & 2;
    const ArcCentre centre = centreByRadius(dx, dy, is_long ? -wide : wide, clockwise);
    ASSERT_TRUE(centre.found);
    const float from = std::hypot(centre.x, centre.y);
    const float to = std::hypot(centre.x - dx, centre.y - dy);
    ASSERT_NEAR(wide, from, 1e-5 * double(wide) + 1e-3);
    ASSERT_NEAR(from, to, 2e-6 * double(wide) + 1e-3);
    ASSERT_EQ(is_long, sweep(dx, dy, centre, clockwise) > M_PI);
  }
}

TEST(ArcCentre, OfAHalfCircleWithRoundedRadiusIsTheMidpoint) {
  const ArcCentre centre = centreByRadius(100, 0, 49.97f, true);
  ASSERT_TRUE(centre.found);
  EXPECT_NEAR(50, centre.x, 1e-4);
  EXPECT_TRUE(centreByRadius(2000, 0, 999.2f, true).found);
}

TEST(ArcCentre, OfAHalfCircleWithRadiusRoundedUpIsTheMidpoint) {
  EXPECT_NEAR(0, centreByRadius(100, 0, 50.001f, true).y, 1e-4);
  EXPECT_NEAR(std::sqrt(50.0015 * 50.0015 - 2500),
              -double(centreByRadius(100, 0, 50.0015f, true).y), 0.01);
  EXPECT_NEAR(0, centreByRadius(100, 0, 50.003f, true, kInchSpare).y, 1e-4);
  EXPECT_GT(-centreByRadius(100, 0, 50.0033f, true, kInchSpare).y, 0.5f);
}

TEST(ArcCentre, IsNotFoundIfTheRadiusIsTooShort) {
  EXPECT_TRUE(centreByRadius(100, 0, 49.93f, true).found);
  EXPECT_FALSE(centreByRadius(100, 0, 49.92f, true).found);
  EXPECT_FALSE(centreByRadius(100, 0, -30, false).found);
  EXPECT_FALSE(centreByRadius(100, 0, 0, false).found);
}

TEST(ArcCentre, IsNotFoundIfTheArcEndsWhereItBegins) {
  EXPECT_FALSE(centreByRadius(0, 0, 50, true).found);
}

TEST(ArcCentre, IsNotFoundForNaN) {
  EXPECT_FALSE(centreByRadius(NAN, 0, 50, true).found);
  EXPECT_FALSE(centreByRadius(1, 0, NAN, true).found);
}
