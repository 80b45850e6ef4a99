// Short moves share exact places: a tile's error, its place and size, when it is laid, and that
// ends stay exact.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "machines.h"
#include "plain.h"

using namespace motion;

namespace {

class TileOf : public testing::TestWithParam<Tried> {};
INSTANTIATE_TEST_SUITE_P(Machines, TileOf, testing::ValuesIn(triedMachines()), NameOfTried());

float nearest(const Sprockets<float>& sprockets, Point<float> place) {
  return std::fmin(path_detail::distance(place, sprockets.left),
                   path_detail::distance(place, sprockets.right));
}

double worse(const Knot& knot, const Lengths<double>& exact) {
  return fmax(fabs(toMm<double>(knot.left) - exact.left),
              fabs(toMm<double>(knot.right) - exact.right));
}

/// Results of a stream of short moves on a machine.
struct Streamed {
  double error = 0;          // [mm] of a chain
  double across = 0;         // [mm] largest extent of the places asked for
  int asked = 0, ticks = 0;  // inverses, set-points
  int asked_at_once = 0;     // most inverses in a single filling
  bool ends_exactly = false;
};

/// Around a circle of 5 mm in steps, again and again; `waiting` set-points wait before each
/// filling.
Streamed stream(const Tried& tried, Point<float> centre, float step, const SmoothArea& area,
                int waiting) {
  const Exactly<double> judge = exactly<double>(tried);
  const Exactly<float> inverse = exactly<float>(tried);
  Streamed streamed;
  int at_once = 0;
  const auto counted = [&](Point<float> place) {
    ++streamed.asked;
    ++at_once;
    streamed.across = fmax(streamed.across, fabs(double(place.x)));
    return inverse(place);
  };
  Mover mover;
  mover.prepare({100, 10, 20, 0.66f, 0.05f}, 0.01f);
  mover.setSprockets(sprocketsOf(tried));
  mover.setArea(area);
  Point<float> at = {centre.x + 5, centre.y};
  const Knot start = knotAt(inverse, at).knot;
  mover.standAt({start.left, start.right, 0});
  for (int sent = 1; sent <= 600 || !mover.isIdle();) {
    for (; sent <= 600 && mover.hasRoom(); ++sent) {
      const float angle = float(sent) * step / 5;
      const Point<float> to = {centre.x + 5 * std::cos(angle), centre.y + 5 * std::sin(angle)};
      EXPECT_EQ(Added::kYes, mover.add(line(at, to), 0, 15));
      at = to;
    }
    SetPoints ring;
    for (int i = 0; i < waiting; ++i) {
      ring.vacant() = {mover.last(), 1, 1, 0};
      ring.push();
    }
    at_once = 0;
    EXPECT_EQ(Filled::kYes, mover.fill(ring, counted));
    if (streamed.ticks != 0) streamed.asked_at_once = std::max(streamed.asked_at_once, at_once);
    streamed.ticks += SetPoints::kMost - waiting;
    if (mover.isIdle()) break;
    const Path<float>& path = mover.queue().first().path;
    const Point<float> place = placeOn(path, mover.walk().done / path.length);
    const Knot now = {mover.last().left, mover.last().right};
    streamed.error = fmax(streamed.error, worse(now, judge(Point<double>{place.x, place.y})));
  }
  const Knot end = knotAt(inverse, at).knot;
  streamed.ends_exactly = end.left == mover.last().left && end.right == mover.last().right;
  return streamed;
}

const SmoothArea kSheetArea = {float(kHalfWidth), float(kHalfHeight)};

}  // namespace

TEST_P(TileOf, LengthsAreWithinTwoMicrometresOfTheExactChains) {
  const Exactly<double> judge = exactly<double>(GetParam());
  const Exactly<float> inverse = exactly<float>(GetParam());
  const Sprockets<float> sprockets = sprocketsOf(GetParam());
  Paths random(8);
  double worst = 0;
  for (int i = 0; i < 400; ++i) {
    const Point<double> middle = random.place();
    const Point<float> at = {float(middle.x), float(middle.y)};
    const float half = halfTile(nearest(sprockets, at), sprockets.effects);
    Tile tile;
    ASSERT_TRUE(tile.lay({at, half}, inverse));
    for (int k = 0; k < 40; ++k) {
      const Point<float> place = {at.x + half * float(random.between(-1, 1)),
                                  at.y + half * float(random.between(-1, 1))};
      if (!tile.holds(place)) continue;  // by rounding
      worst = fmax(worst, worse(tile.at(place), judge(Point<double>{place.x, place.y})));
    }
  }
  EXPECT_LT(worst, 0.002);
}

TEST(Tile, MissesACubicByNoMoreThanAllowed) {
  for (const double third : {1e-6, 1e-4, 4e-4}) {
    const auto cubic = [&](Point<float> place) -> Lengths<float> {
      const double x = place.x, y = place.y;
      return {float(third * (x * x * x + y * y * y) / 6), 50, true};
    };
    Tile tile;
    const float half = halfTile(1e6f, {0, 0, float(third)});
    ASSERT_TRUE(tile.lay({{0, 0}, half}, cubic));
    double worst = 0;
    for (int i = -20; i <= 20; ++i)
      for (int k = -20; k <= 20; ++k) {
        const Point<float> place = {half * float(i) / 20.0f, half * float(k) / 20.0f};
        const double exact = double(cubic(place).left);
        worst = fmax(worst, fabs(toMm<double>(tile.at(place).left) - exact));
        EXPECT_EQ(toCounts(50.0f), tile.at(place).right);
      }
    EXPECT_LT(worst, double(kMostMissedInTile)) << third;
    const bool is_largest = half == kLargestHalfTile;
    EXPECT_GT(worst, is_largest ? 0.0 : 0.7 * double(kMostMissedInTile)) << third;
  }
}

TEST(Tile, HoldsItsSquareAndNothingAfterARefusal) {
  Tile tile;
  EXPECT_FALSE(tile.holds({0, 0}));
  ASSERT_TRUE(tile.lay({{100, -50}, 4}, plainInverse));
  EXPECT_TRUE(tile.holds({96.1f, -53.9f}));
  EXPECT_FALSE(tile.holds({104.1f, -50}));
  EXPECT_FALSE(tile.holds({100, -45.9f}));
  EXPECT_EQ(toCounts(97.5f), tile.at({97.5f, -52}).left);
  EXPECT_EQ(toCounts(-52.0f), tile.at({97.5f, -52}).right);
  // One corner is out of reach.
  EXPECT_FALSE(tile.lay({{2997, 0}, 4}, plainInverse));
  EXPECT_FALSE(tile.holds({2997, 0}));
  EXPECT_FALSE(tile.holds({100, -50}));
}

TEST(Tile, IsSmallEnoughForItsCornerNextToTheSprocket) {
  // Laid ahead of a place, it reaches 2.2 halves of the largest tile nearer.
  const double third = 1.1547 / (167 * 167);
  EXPECT_LE(double(halfTile(200, {0, 0, 0})),
            0.5 * cbrt(double(kMostMissedInTile) * 124.7077 / 2.25 / third));
}

TEST_P(TileOf, ShortMovesAskForOneInverseInManyTicks) {
  for (const Point<float> centre : {Point<float>{0, 0}, {-1150, 560}, {1150, -560}}) {
    const Streamed streamed = stream(GetParam(), centre, 0.3f, kSheetArea, 10);
    EXPECT_LT(streamed.error, 0.003);
    EXPECT_LT(streamed.asked, streamed.ticks / 5);
    EXPECT_TRUE(streamed.ends_exactly);
  }
}

TEST(Tiles, AreNotComputedInAHurry) {
  // Nine inverses at once would let seven set-points run dry.
  const Streamed enough = stream(triedMachines()[0], {300, 0}, 0.3f, kSheetArea, 10);
  EXPECT_GE(enough.asked_at_once, 9);
  const Exactly<float> inverse = exactly<float>(triedMachines()[0]);
  Tiles tiles;
  tiles.setArea(kSheetArea);
  int asked = 0;
  const auto counted = [&](Point<float> place) {
    ++asked;
    return inverse(place);
  };
  const Path<float> path = line(Point<float>{0, 0}, Point<float>{0.3f, 0});
  tiles.setTime(false);
  tiles.lengthsAt({0.1f, 0}, path, sprocketsOf(triedMachines()[0]), counted);
  EXPECT_EQ(1, asked);
  tiles.setTime(true);
  tiles.lengthsAt({0.1f, 0}, path, sprocketsOf(triedMachines()[0]), counted);
  EXPECT_EQ(10, asked);
  // Another frame: old places no longer count.
  tiles.setArea(kSheetArea);
  tiles.setTime(false);
  tiles.lengthsAt({0.1f, 0}, path, sprocketsOf(triedMachines()[0]), counted);
  EXPECT_EQ(11, asked);
}

TEST(Tiles, AreNotComputedWhileFewSetPointsWait) {
  const Exactly<float> inverse = exactly<float>(triedMachines()[0]);
  SetPoints ring;
  int asked[SetPoints::kMost + 1] = {};  // by the number that waited
  const auto counted = [&](Point<float> place) {
    ++asked[ring.count()];
    return inverse(place);
  };
  Mover mover;
  mover.prepare({100, 10, 20, 0.66f, 0.05f}, 0.01f);
  mover.setSprockets(sprocketsOf(triedMachines()[0]));
  const Knot start = knotAt(inverse, Point<float>{0, 0}).knot;
  mover.standAt({start.left, start.right, 0});
  for (int i = 0; i < 16; ++i)
    mover.add(line(Point<float>{0.3f * float(i), 0}, Point<float>{0.3f * float(i + 1), 0}), 0, 15);
  mover.fill(ring, counted);
  // Some set-points are taken first, so that tiles are in use.
  Leg taken;
  for (int i = 0; i < 8; ++i) ring.take(taken);
  mover.setArea(kSheetArea);
  for (int& each : asked) each = 0;
  mover.fill(ring, counted);
  for (int waiting = 0; waiting < 8; ++waiting) EXPECT_LE(asked[waiting], 2) << waiting;
  EXPECT_GE(asked[8] + asked[9] + asked[10], 9);
}

namespace {

const Sprockets<float> kNear = {{-300, 400}, {300, 400}, {0, 0, 0}};
const SmoothArea kArea = {280, 270};

/// Places that are asked for where tiles come to a place on a path.
std::vector<Point<float>> askedAt(Point<float> place, Point<float> towards,
                                  const SmoothArea& area = kArea, bool has_time = true) {
  std::vector<Point<float>> asked;
  const auto inverse = [&](Point<float> at) {
    asked.push_back(at);
    return Lengths<float>{std::hypot(at.x + 300, at.y - 400), std::hypot(at.x - 300, at.y - 400),
                          true};
  };
  Tiles tiles;
  tiles.setArea(area);
  tiles.setTime(has_time);
  const Path<float> path = line(place, {place.x + towards.x, place.y + towards.y});
  EXPECT_TRUE(tiles.lengthsAt(place, path, kNear, inverse).reachable);
  return asked;
}

/// The square around some places: its middle and half its side.
Square squareAround(const std::vector<Point<float>>& places) {
  float low_x = 1e9f, high_x = -1e9f, low_y = 1e9f, high_y = -1e9f;
  for (const Point<float>& place : places) {
    low_x = std::min(low_x, place.x), high_x = std::max(high_x, place.x);
    low_y = std::min(low_y, place.y), high_y = std::max(high_y, place.y);
  }
  EXPECT_NEAR(double(high_x - low_x), double(high_y - low_y), 0.001);
  return {{(low_x + high_x) / 2, (low_y + high_y) / 2}, (high_x - low_x) / 2};
}

}  // namespace

TEST(TilePlaces, AreAsFarApartAsTheNearerSprocketAllows) {
  for (const float side : {-1.0f, 1.0f}) {
    const std::vector<Point<float>> asked = askedAt({side * 150, 200}, {1, 0});
    ASSERT_EQ(9u, asked.size());
    // 250 mm from the nearer sprocket, 492 from the other.
    EXPECT_NEAR(double(squareAround(asked).half), double(halfTile(250, {0, 0, 0})), 0.001) << side;
  }
  EXPECT_LT(halfTile(250, {0, 0, 0}), 0.8f * halfTile(492, {0, 0, 0}));
}

TEST(TilePlaces, BeginJustBehindThePlaceWhicheverWayThePathLeads) {
  const Point<float> place = {20, -30};
  for (const Point<float>& towards :
       {Point<float>{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {0.6f, -0.8f}, {-0.3f, -0.4f}}) {
    const Square square = squareAround(askedAt(place, towards));
    const float length = std::hypot(towards.x, towards.y);
    EXPECT_NEAR(double(square.middle.x), double(place.x + 0.8f * square.half * towards.x / length),
                0.001)
        << towards.x << " " << towards.y;
    EXPECT_NEAR(double(square.middle.y), double(place.y + 0.8f * square.half * towards.y / length),
                0.001)
        << towards.x << " " << towards.y;
  }
}

TEST(TilePlaces, LieOnTheArea) {
  for (const Point<float>& corner : {Point<float>{280, 270}, {-280, -270}, {280, -270}}) {
    const std::vector<Point<float>> asked = askedAt(corner, {corner.x / 280, corner.y / 270});
    ASSERT_EQ(9u, asked.size()) << corner.x << " " << corner.y;
    for (const Point<float>& place : asked) {
      EXPECT_LE(std::fabs(place.x), 280.001f);
      EXPECT_LE(std::fabs(place.y), 270.001f);
    }
  }
}

TEST(TilePlaces, AreNotUsedBeyondTheAreaOrInATinyOne) {
  EXPECT_EQ(1u, askedAt({281, 0}, {1, 0}).size());
  EXPECT_EQ(1u, askedAt({0, -271}, {1, 0}).size());
  EXPECT_EQ(1u, askedAt({0, 0}, {1, 0}, {15, 270}).size());
  EXPECT_EQ(1u, askedAt({0, 0}, {1, 0}, {280, 15}).size());
  EXPECT_EQ(9u, askedAt({0, 0}, {1, 0}, {280, 16}).size());
  EXPECT_EQ(1u, askedAt({0, 0}, {1, 0}, kArea, false).size()) << "no time";
}
