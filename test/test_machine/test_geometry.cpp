// What the settings of the frame mean for the chains.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "machine/geometry.h"
#include "settings_flash.h"

using namespace machine;

namespace {

/// The shape of a machine with these settings, by their $-numbers.
struct Shaped {
  explicit Shaped(std::initializer_list<std::pair<int, float>> settings) : values(table, room) {
    for (const auto& [number, value] : settings)
      EXPECT_EQ(settings::Refusal::kNone, values.set(uint8_t(number), value)) << "$" << number;
    geometry.prepare(values);
  }

  FlashTable table;
  float room[kSettingCount];
  settings::Values values;
  Geometry geometry;
};

const motion::Point<float> kPlaces[] = {{0, 0}, {-900, 400}, {900, 400}, {-900, -500}, {900, -500}};

}  // namespace

TEST(FrameSettings, MotorCenterMovesTheSprocketsToTheRight) {
  for (const float kinematics : {1.0f, 2.0f}) {
    const Shaped centred({{7, kinematics}, {8, 139}, {10, 5000}});
    const Shaped aside({{7, kinematics}, {8, 139}, {10, 5000}, {64, 37}});
    EXPECT_FLOAT_EQ(centred.geometry.sprockets().left.x + 37, aside.geometry.sprockets().left.x);
    EXPECT_FLOAT_EQ(centred.geometry.sprockets().right.x + 37, aside.geometry.sprockets().right.x);
    for (const motion::Point<float>& place : kPlaces) {
      const motion::Lengths<float> asked = aside.geometry.inverse({place.x + 37, place.y});
      const motion::Lengths<float> same = centred.geometry.inverse(place);
      EXPECT_NEAR(double(same.left), double(asked.left), 0.002) << place.x << ", " << place.y;
      EXPECT_NEAR(double(same.right), double(asked.right), 0.002) << place.x << ", " << place.y;
      const FoundPlace hangs = aside.geometry.forward(asked.left, asked.right, {0, 0});
      EXPECT_NEAR(double(place.x + 37), double(hangs.at.x), 0.01) << "$7=" << kinematics;
      EXPECT_NEAR(double(place.y), double(hangs.at.y), 0.01) << "$7=" << kinematics;
    }
  }
}

TEST(SledsWeight, TorqueFollowsTheLawOfSines) {
  const double weight = 110, gap = 3000, radius = 63.5 / 6.283185307;
  const Shaped shaped({{7, 2}, {2, float(gap)}, {62, float(weight)}, {64, 50}});
  const motion::Sprockets<float>& sprockets = shaped.geometry.sprockets();
  for (const motion::Point<float>& place : kPlaces) {
    const double up = double(sprockets.left.y - place.y);
    const double left = std::atan2(up, double(place.x - sprockets.left.x));
    const double right = std::atan2(up, double(sprockets.right.x - place.x));
    const double pull = std::max(std::cos(left), std::cos(right)) / std::sin(left + right);
    EXPECT_NEAR(weight * pull * radius, double(shaped.geometry.torqueAt(place)), 0.5)
        << place.x << ", " << place.y;
  }
}

TEST(FrameSettings, NoMoreChainIsPaidOutThanItsLength) {
  const Shaped usual({{7, 2}, {8, 139}, {10, 5000}});
  const motion::Point<float> corner = {-1000, -500};
  const motion::Lengths<float> lengths = usual.geometry.inverse(corner);
  ASSERT_GT(lengths.right, lengths.left);
  const Shaped enough({{7, 2}, {8, 139}, {10, float(int(lengths.right) + 1)}});
  const Shaped tooShort({{7, 2}, {8, 139}, {10, float(int(lengths.right))}});
  EXPECT_TRUE(enough.geometry.isReachable(corner)) << lengths.right;
  EXPECT_FALSE(tooShort.geometry.isReachable(corner)) << "right, " << lengths.right;
  EXPECT_FALSE(tooShort.geometry.isReachable({1000, -500})) << "left, " << lengths.right;
}

TEST(FrameSettings, PlacesAboveTheMotorsAreOutOfReach) {
  const Shaped usual({{7, 2}, {8, 139}, {10, 5000}});
  EXPECT_FALSE(usual.geometry.isReachable({0, 1500}));
  EXPECT_FALSE(usual.geometry.isReachable({300, 1100}));
}

TEST(FrameSettings, APlaceIsFoundFromAnyGuess) {
  const Shaped usual({{7, 2}, {8, 139}, {10, 5000}});
  const motion::Lengths<float> lengths = usual.geometry.inverse({500, -300});
  for (const motion::Point<float>& guess : {motion::Point<float>{0, 0}, {-1200, 600}, {0, 9000}}) {
    const FoundPlace place = usual.geometry.forward(lengths.left, lengths.right, guess);
    EXPECT_TRUE(place.found) << guess.x << ", " << guess.y;
    EXPECT_NEAR(500, double(place.at.x), 0.01) << guess.x << ", " << guess.y;
  }
}

TEST(FrameSettings, RunoutStaysWithinTheBound) {
  const Shaped round({{7, 2}, {8, 139}, {10, 5000}});
  const Shaped uneven({{7, 2}, {8, 139}, {10, 5000}, {190, 0.5f}});
  const double allowed = double(uneven.geometry.sprockets().effects.first) -
                         double(round.geometry.sprockets().effects.first);
  const auto added = [&](float x, float y) {
    return double(uneven.geometry.inverse({x, y}).left) -
           double(round.geometry.inverse({x, y}).left);
  };
  double steepest = 0;
  for (float x = -1000; x < 1000; x += 37)
    for (float y = -500; y < 500; y += 41) {
      steepest = std::max(steepest, std::fabs(added(x + 4, y) - added(x, y)) / 4);
      steepest = std::max(steepest, std::fabs(added(x, y + 4) - added(x, y)) / 4);
    }
  EXPECT_GT(steepest, 0.02) << "half a millimetre on a sprocket of 10";
  EXPECT_LE(steepest, allowed + 2e-4);
  EXPECT_LE(allowed, 2 * steepest) << "and the bound is no excuse";
}
