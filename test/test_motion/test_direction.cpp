// The direction of a path at its ends, and the speed at a corner.
#include <gtest/gtest.h>

#include "plain.h"

using namespace motion;

namespace {

/// The direction of a path where it begins or ends, by a small step in double.
Point<double> byHand(const Path<float>& path, bool at_end) {
  const Path<double> exact = arc(Point<double>{double(path.from.x), double(path.from.y)},
                                 Point<double>{double(path.to.x), double(path.to.y)},
                                 Point<double>{double(path.centre.x), double(path.centre.y)},
                                 path.sweep > 0 ? Turn::kCounterclockwise : Turn::kClockwise);
  const double kStep = 1e-6;
  const Point<double> a = placeOn(exact, at_end ? 1 - 2 * kStep : 0);
  const Point<double> b = placeOn(exact, at_end ? 1 - kStep : kStep);
  const double length = std::hypot(b.x - a.x, b.y - a.y);
  return {(b.x - a.x) / length, (b.y - a.y) / length};
}

}  // namespace

TEST(Direction, OfAnArcIsThatOfASmallStep) {
  const Point<float> centre = {310, -170};
  for (const Turn turn : {Turn::kClockwise, Turn::kCounterclockwise})
    for (const double begin : {0.3, 1.9, 4.0})
      for (const float radius : {0.5f, 40.0f})
        for (const float grown : {-0.07f, 0.0f, 0.07f}) {
          const auto at = [&](double angle, float from_centre) {
            return Point<float>{centre.x + from_centre * float(std::cos(angle)),
                                centre.y + from_centre * float(std::sin(angle))};
          };
          const Path<float> path =
              arc(at(begin, radius), at(begin + 1.1, radius + grown), centre, turn);
          ASSERT_EQ(Drawn::kYes, path.drawn);
          for (const bool at_end : {false, true}) {
            const Point<float> seen = directionOf(path, at_end);
            const Point<double> expected = byHand(path, at_end);
            EXPECT_NEAR(double(seen.x), expected.x, 0.002)
                << begin << " " << radius << " " << grown;
            EXPECT_NEAR(double(seen.y), expected.y, 0.002)
                << begin << " " << radius << " " << grown;
          }
        }
}

TEST(Direction, IsConstantOnALineAndZeroWithoutAPath) {
  const Path<float> path = line(Point<float>{100, 50}, {103, 46});
  for (const bool at_end : {false, true}) {
    EXPECT_FLOAT_EQ(0.6f, directionOf(path, at_end).x);
    EXPECT_FLOAT_EQ(-0.8f, directionOf(path, at_end).y);
  }
  const Path<float> none = line(Point<float>{1, 1}, {1, 1});
  EXPECT_EQ(0, directionOf(none, false).x);
  EXPECT_EQ(0, directionOf(none, false).y);
}

TEST(Corner, GoingStraightHasNoLimitAtAnyDeviation) {
  const Direction along = {0.6f, 0.48f, 0.64f};
  for (const float deviation : {0.0f, 0.05f})
    EXPECT_EQ(kAnySpeedSquared, cornerSpeedSquared(along, along, 0.01f, deviation, 10))
        << deviation;
  const Direction turned = {0.8f, 0.6f, 0};
  EXPECT_EQ(0, cornerSpeedSquared(along, turned, 0.01f, 0, 10)) << "each corner is a stop";
}

TEST(Corner, DoesNotDependOnTheDirectionOfTheAxes) {
  // The same turn of 0.1, in each plane and both ways round.
  const float c = float(std::cos(0.1)), s = float(std::sin(0.1));
  const Direction pairs[][2] = {{{1, 0, 0}, {c, s, 0}},   {{1, 0, 0}, {c, -s, 0}},
                                {{0, 1, 0}, {s, c, 0}},   {{0, 0, 1}, {0, s, c}},
                                {{0, c, s}, {0, 1, 0}},   {{c, 0, s}, {1, 0, 0}},
                                {{-1, 0, 0}, {-c, s, 0}}, {{0, -c, -s}, {0, -1, 0}}};
  for (const auto& pair : pairs)
    EXPECT_NEAR(double(cornerSpeedSquared(pair[0], pair[1], 1, 0.05f, 0.2f)), 0.25 / 0.1, 0.01)
        << pair[1].x << " " << pair[1].y << " " << pair[1].z;
}

TEST(SagSlopes, AreRightForEachPowerAlone) {
  // Where the other three hardly change, u^p has the slopes p, p(p+1), p(p+1)(p+2) over u, u^2,
  // u^3.
  const double u = 700, far = 1e9;
  for (int i = 0; i < 4; ++i) {
    double all[] = {far, far, far, far};
    all[i] = u;
    const double p = i == 3 ? 1 : 2;
    const Slopes<double> slopes = sagSlopes(8.0, all[0], all[1], all[2], all[3]);
    EXPECT_NEAR(slopes.first, 8 * p / u, 1e-6) << i;
    EXPECT_NEAR(slopes.second, 8 * p * (p + 1) / u / u, 1e-8) << i;
    EXPECT_NEAR(slopes.third, 8 * p * (p + 1) * (p + 2) / u / u / u, 1e-11) << i;
  }
}
