// Curves of arcs stay as near to the intended curve as their text allows, in inches and in mm.
#include <gtest/gtest.h>

#include <algorithm>

#include "curves/curve.h"
#include "machines.h"
#include "plain.h"

using namespace motion;

namespace {

/// Text of a program: its last digit, and the coarsest digit that the firmware assumes for its
/// unit.
struct Text {
  const char* name;
  double digit;  ///< [mm]
  float coarsest;
};

const Text kTexts[] = {{"InchesOfThreeDecimals", 0.0254, kInchDigit},
                       {"InchesOfFourDecimals", 0.00254, kInchDigit},
                       {"MillimetresOfTwoDecimals", 0.01, kMillimetreDigit},
                       {"MillimetresOfThreeDecimals", 0.001, kMillimetreDigit}};

Point<float> single(SheetPlace place) { return {float(place.x), float(place.y)}; }

Path<float> drawn(const Meant& meant, const Text& text) {
  const Rounded words = rounded(meant, text.digit);
  return arc(single(words.from), single(words.to), single(words.centre),
             meant.sweep > 0 ? Turn::kCounterclockwise : Turn::kClockwise, text.coarsest);
}

/// Largest distance [mm] between a drawn path and the intended arc, in both directions.
double farthest(const Path<float>& path, const Meant& meant) {
  const int steps = 60;
  std::vector<SheetPlace> drawn;
  double off = 0;
  for (int i = 0; i <= steps; ++i) {
    const Point<float> place = placeOn(path, float(i) / steps);
    drawn.push_back({place.x, place.y});
    off = std::max(off, meant.distanceTo(drawn.back()));
  }
  for (int i = 0; i <= steps; ++i) {
    const SheetPlace place = meant.at(double(i) / steps);
    double nearest = 1e9;
    for (int k = 0; k < steps; ++k) {
      const double dx = drawn[k + 1].x - drawn[k].x, dy = drawn[k + 1].y - drawn[k].y;
      const double length = std::max(dx * dx + dy * dy, 1e-18);
      const double along = ((place.x - drawn[k].x) * dx + (place.y - drawn[k].y) * dy) / length;
      const double share = std::min(1.0, std::max(0.0, along));
      nearest = std::min(nearest, std::hypot(place.x - drawn[k].x - share * dx,
                                             place.y - drawn[k].y - share * dy));
    }
    off = std::max(off, nearest);
  }
  return off;
}

class RoundedArcs : public testing::TestWithParam<Text> {};

struct NameOfText {
  std::string operator()(const testing::TestParamInfo<Text>& info) const { return info.param.name; }
};

/// Start, end and centre are each off by up to half a digit along both axes, so places of the arc
/// may be off by the first number [digits]. Rounding to float moves places by the second [mm].
const double kMostDigits = 1.35, kFloat = 2e-4;

}  // namespace

TEST_P(RoundedArcs, AreDrawnWithinTheRoundingOfTheirText) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Curve curve(seed, M_PI);
    for (int i = 0; i < 100; ++i) {
      const Meant meant = curve.next();
      const Path<float> path = drawn(meant, GetParam());
      ASSERT_EQ(Drawn::kYes, path.drawn) << seed << " " << i;
      ASSERT_LE(farthest(path, meant), kMostDigits * GetParam().digit + kFloat)
          << "radius " << meant.radius << " sweep " << meant.sweep << " seed " << seed;
    }
  }
}

TEST_P(RoundedArcs, OfMoreThanAHalfTurnAreDrawnToo) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Curve curve(seed, 5.5);
    for (int i = 0; i < 100; ++i) {
      const Meant meant = curve.next();
      // Nearer ends may belong to a short arc too, and so may the ends of a smaller circle.
      const double gap = std::hypot(meant.to.x - meant.from.x, meant.to.y - meant.from.y);
      const bool may_be_short =
          gap < 3 * double(GetParam().coarsest) || meant.radius < 4 * GetParam().digit;
      if (std::fabs(meant.sweep) > M_PI && may_be_short) continue;
      // The far side of a circle is off by the rounding of I and J twice.
      ASSERT_LE(farthest(drawn(meant, GetParam()), meant), 2.13 * GetParam().digit + kFloat)
          << "radius " << meant.radius << " sweep " << meant.sweep << " seed " << seed;
    }
  }
}

TEST_P(RoundedArcs, RunWithoutAJumpInAnyDirection) {
  const double most = double(kGentle.acceleration_xy) * kTick;  // [mm/s] each tick
  for (unsigned seed = 1; seed <= 4; ++seed) {
    Curve curve(seed, M_PI);
    for (int i = 0; i < 100; ++i) {
      const Path<float> path = drawn(curve.next(), GetParam());
      Plain plain;
      plain.mover.standAt({toCounts(path.from.x), toCounts(path.from.y), 0});
      plain.asked.push_back({double(path.from.x), double(path.from.y), 0});
      plain.add(path, 0, 15);
      plain.run();
      const std::vector<Asked>& at = plain.asked;
      for (std::size_t k = 2; k < at.size(); ++k) {
        const double x = at[k].x - 2 * at[k - 1].x + at[k - 2].x;
        const double y = at[k].y - 2 * at[k - 1].y + at[k - 2].y;
        ASSERT_LE(std::hypot(x, y) / kTick, 1.5 * most) << seed << " " << i << " tick " << k;
      }
      ASSERT_NEAR(double(path.to.x), at.back().x, 1e-3);
      ASSERT_NEAR(double(path.to.y), at.back().y, 1e-3);
    }
  }
}

TEST(Spirals, AreFollowedWithinTheLimitOfASegment) {
  Paths paths(8);
  int spirals = 0;
  for (int i = 0; i < 300; ++i) {
    const double radius = paths.between(0.1, 0.4), angle = paths.between(1, 6);
    const double end = radius + paths.between(-0.06, 0.06);
    const Path<float> path =
        arc(Point<float>{float(radius), 0}, single({end * cos(angle), end * sin(angle)}),
            Point<float>{0, 0}, Turn::kCounterclockwise);
    spirals += std::fabs(end - radius) > 0.1 * double(path.length);
    Plain plain;
    plain.mover.standAt({toCounts(path.from.x), toCounts(path.from.y), 0});
    plain.add(path, 0, 1);
    plain.run();
    double worst = 0;
    for (const Asked& at : plain.asked) {
      double nearest = 1e9;
      for (int k = 0; k <= 1500; ++k) {
        const Point<float> place = placeOn(path, float(k) / 1500);
        nearest = std::min(nearest, std::hypot(double(place.x) - at.x, double(place.y) - at.y));
      }
      worst = std::max(worst, nearest);
    }
    ASSERT_LT(worst, 0.001) << radius << " " << end << " " << angle;
  }
  EXPECT_GT(spirals, 20);
}

INSTANTIATE_TEST_SUITE_P(, RoundedArcs, testing::ValuesIn(kTexts), NameOfText());
