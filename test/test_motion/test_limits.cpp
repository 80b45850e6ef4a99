// Limits of speed that follow from the path: its direction, centripetal acceleration, corners,
// speeds of chains.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "plain.h"

using namespace motion;

namespace {

/// Nothing but the acceleration limits these moves: 100 mm/s^2.
const Limits kFree = {100, 1000, 1000, 1000, 0.05f};

/// Greatest speed along the sheet, from tick to tick [mm/s].
double fastest(const Plain& plain) {
  double most = 0;
  Asked before = {0, 0, 0};
  for (const Asked& each : plain.asked) {
    most = std::max(most, std::hypot(each.x - before.x, each.y - before.y) / plain.seconds);
    before = each;
  }
  return most;
}

/// A full circle that rises by `rise` [mm], with a feed beyond what any arc here allows.
double fastestRound(float radius, float rise) {
  Plain plain(kFree);
  plain.arcTo(0, 0, {radius, 0}, 500, rise);
  plain.run();
  return fastest(plain);
}

Direction direction(double angle) { return {float(std::cos(angle)), float(std::sin(angle)), 0}; }

/// Greatest share of the way along a line by which either chain grows or shrinks, by small steps.
double steepestByHand(const Path<double>& path, const Sprockets<double>& sprockets) {
  const int kSteps = 500;
  double most = 0;
  for (const Point<double>& sprocket : {sprockets.left, sprockets.right})
    for (int i = 0; i < kSteps; ++i) {
      const auto away = [&](double share) {
        return std::hypot(path.from.x + share * (path.to.x - path.from.x) - sprocket.x,
                          path.from.y + share * (path.to.y - path.from.y) - sprocket.y);
      };
      const double step = path.length / kSteps;
      most = std::max(most, std::fabs(away((i + 1.0) / kSteps) - away(double(i) / kSteps)) / step);
    }
  return most;
}

}  // namespace

TEST(ArcLimit, CentripetalAccelerationIsTheLimit) {
  for (const float radius : {1.0f, 4.0f, 25.0f}) {
    const double may = std::sqrt(100 * double(radius));
    EXPECT_NEAR(fastestRound(radius, 0), may, 0.02 * may) << "radius " << radius;
    EXPECT_NEAR(fastestRound(radius, 3 * radius), may, 0.02 * may) << "helix of radius " << radius;
  }
}

TEST(CornerLimit, SpreadsTheTurnOverShortMoves) {
  const float acceleration = 0.01f, deviation = 0.05f;
  for (const double turn : {0.02, 0.1, 0.2})
    for (const float room : {0.0f, 0.02f, 0.2f}) {
      const double expected = double(acceleration) * double(room + deviation) / turn;
      EXPECT_NEAR(double(cornerSpeedSquared(direction(1), direction(1 + turn), acceleration,
                                            deviation, room)),
                  expected, 0.002 * expected)
          << "turn " << turn << ", room " << room;
    }
}

TEST(CornerLimit, OfLongMovesIsTheArcWithinTheDeviation) {
  const float acceleration = 0.01f, deviation = 0.05f, room = 1000;
  for (const double turn : {0.1, 0.8, 1.6, 2.5, 3.0}) {
    // The arc touches both sides and passes the corner at the deviation.
    const double cosine = std::cos(turn / 2);
    const double radius = double(deviation) * cosine / (1 - cosine);
    EXPECT_NEAR(
        double(cornerSpeedSquared(direction(0), direction(turn), acceleration, deviation, room)),
        double(acceleration) * radius, 0.002 * double(acceleration) * radius + 1e-7)
        << "turn " << turn;
  }
  EXPECT_EQ(0,
            cornerSpeedSquared(direction(0), direction(3.14159265), acceleration, deviation, 0.0f))
      << "straight back";
}

TEST(Steepest, IsTheSlopeOfTheChainThatChangesMostAtEitherEnd) {
  const Sprockets<double> sprockets = {{-1289, 1073}, {1689, 973}, {0.002, 0, 0}};
  std::mt19937 random(7);
  std::uniform_real_distribution<double> x(-1200, 1200), y(-600, 600);
  for (int i = 0; i < 200; ++i) {
    const Path<double> path = line(Point<double>{x(random), y(random)}, {x(random), y(random)});
    EXPECT_NEAR(steepest(path, sprockets), steepestByHand(path, sprockets) + 0.002, 0.004)
        << "from " << path.from.x << ", " << path.from.y << " to " << path.to.x << ", "
        << path.to.y;
  }
}

TEST(Steepest, IsTheFullSlopeOnAnArcAndThroughASprocket) {
  const Sprockets<double> sprockets = {{-1000, 0}, {1000, 0}, {0.002, 0, 0}};
  const Path<double> round =
      arc(Point<double>{0, -500}, {10, -490}, {0, -490}, Turn::kCounterclockwise);
  EXPECT_NEAR(steepest(round, sprockets), 1.002, 1e-9);
  EXPECT_NEAR(steepest(line(Point<double>{-1000, 0}, {-1000, -300}), sprockets), 1.002, 1e-9);
}

TEST(Surroundings, AreThoseOfTheNearerSprocket) {
  const Sprockets<double> sprockets = {{-1000, 200}, {1000, 100}, {0.1, 0.2, 0.3}};
  for (const double side : {-1.0, 1.0}) {
    const double height = side < 0 ? 200 : 100;
    const Path<double> below = line(Point<double>{side * 980, -400}, {side * 1020, -400});
    EXPECT_NEAR(surroundingsOf(below, sprockets).nearest, 400 + height, 1e-9) << side;
    const Path<double> through = line(Point<double>{side * 1000, -9}, {side * 1000, 500});
    EXPECT_EQ(1, surroundingsOf(through, sprockets).nearest) << "no nearer than a millimetre";
    EXPECT_EQ(0.1, surroundingsOf(below, sprockets).effects.first);
    EXPECT_EQ(0.2, surroundingsOf(below, sprockets).effects.second);
    EXPECT_EQ(0.3, surroundingsOf(below, sprockets).effects.third);
  }
}

TEST(Steepest, IsRightAtEachEndOfEachChain) {
  const Sprockets<double> sprockets = {{-1000, 0}, {1000, 0}, {0, 0, 0}};
  // Each line runs to or from the foot under a sprocket, where that chain does not move.
  struct {
    const char* which;
    Point<double> from, to;
  } lines[] = {{"left, begin", {-400, -600}, {-1000, -1000}},
               {"left, end", {-1000, -1000}, {-400, -600}},
               {"right, begin", {400, -600}, {1000, -1000}},
               {"right, end", {1000, -1000}, {400, -600}}};
  for (const auto& each : lines) {
    const Path<double> path = line(each.from, each.to);
    EXPECT_NEAR(steepest(path, sprockets), steepestByHand(path, sprockets), 0.002) << each.which;
  }
}

TEST(ChainLimit, HoldsForBothChainsOnEveryLine) {
  // Lines that end under a sprocket: the other chain changes by nearly the whole way.
  for (const float side : {-1.0f, 1.0f})
    for (const bool up : {false, true}) {
      Plain plain(kFree);
      Limits slow = kFree;
      slow.chain_speed = 20;
      plain.mover.prepare(slow, 0.01f);
      plain.mover.setSprockets({{-1000, 500}, {1000, 500}, {0, 0, 0}});
      const Point<float> low = {side * 400, -400}, high = {side * 900, 300};
      const Path<float> path = up ? line(low, high) : line(high, low);
      plain.now = {toCounts(path.from.x), toCounts(path.from.y), 0};
      plain.mover.standAt(plain.now);
      plain.mover.add(path, 0, 500);
      plain.run();
      double most = 0, before[2] = {0, 0};
      for (size_t i = 0; i < plain.asked.size(); ++i)
        for (int chain = 0; chain < 2; ++chain) {
          const double sprocket = chain ? 1000 : -1000;
          const double length = std::hypot(plain.asked[i].x - sprocket, plain.asked[i].y - 500);
          if (i != 0) most = std::max(most, std::fabs(length - before[chain]) / 0.01);
          before[chain] = length;
        }
      EXPECT_NEAR(most, 20, 0.1) << "side " << side << (up ? ", up" : ", down");
    }
}

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
