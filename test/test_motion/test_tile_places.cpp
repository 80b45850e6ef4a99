// Where a tile is laid and how large it is, by the places that the exact inverse is asked for.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "plain.h"

using namespace motion;

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
