// What the settings of the frame mean for the chains.
#include <gtest/gtest.h>

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

TEST(FrameSettings, NoMoreChainIsPaidOutThanThereIs) {
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

TEST(FrameSettings, SheetIsCentredOnTheOrigin) {
  const Shaped shaped({{0, 2000}, {1, 1000}});
  EXPECT_FLOAT_EQ(-1000, shaped.geometry.sheet().low.x);
  EXPECT_FLOAT_EQ(1000, shaped.geometry.sheet().high.x);
  EXPECT_FLOAT_EQ(-500, shaped.geometry.sheet().low.y);
  EXPECT_FLOAT_EQ(500, shaped.geometry.sheet().high.y);
  EXPECT_FLOAT_EQ(1000, shaped.geometry.smoothArea().half_width);
  EXPECT_FLOAT_EQ(500, shaped.geometry.smoothArea().half_height);
}
