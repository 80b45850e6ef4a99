// Questions without an answer are refused with a reason: never a wrong length, never a NaN.
#include <gtest/gtest.h>
#include <math.h>

#include "machines.h"

using namespace kinematics;

namespace {

const float kNan = nanf("");

Machine<float> machine() { return lawsOf<float>(triedMachines()[0]); }

Found foundAt(float x, float y) {
  const PaidOut<float> paid = inverse(machine(), Point<float>{x, y});
  if (paid.found != Found::kYes) {
    EXPECT_EQ(0, paid.chains.left);
    EXPECT_EQ(0, paid.chains.right);
  }
  return paid.found;
}

Found foundFor(float left, float right) {
  const Place<float> place = forward(machine(), Chains<float>{left, right});
  return place.found;
}

}  // namespace

TEST(BadInput, PlacesThatAreNaN) {
  EXPECT_EQ(Found::kOutOfReach, foundAt(kNan, 0));
  EXPECT_EQ(Found::kOutOfReach, foundAt(0, kNan));
  EXPECT_EQ(Found::kOutOfReach, foundAt(kNan, kNan));
  EXPECT_EQ(Found::kOutOfReach, foundAt(INFINITY, 0));
  EXPECT_EQ(Found::kOutOfReach, foundAt(0, -INFINITY));
  EXPECT_EQ(Found::kOutOfReach, foundAt(1e30f, -1e30f));
}

TEST(BadInput, PlacesAboveOrBesideTheMotors) {
  EXPECT_EQ(Found::kOutOfReach, foundAt(0, 1072.6f));
  EXPECT_EQ(Found::kOutOfReach, foundAt(0, 1500));
  EXPECT_EQ(Found::kOutOfReach, foundAt(300, 1080));
  EXPECT_EQ(Found::kOutOfReach, foundAt(1600, 0));
  EXPECT_EQ(Found::kOutOfReach, foundAt(-1600, -500));
}

TEST(BadInput, PlacesInsideASprocketOrItsRing) {
  EXPECT_EQ(Found::kOutOfReach, foundAt(-1489.2f, 1072.6f));
  EXPECT_EQ(Found::kOutOfReach, foundAt(1489.2f, 1072.6f));
  EXPECT_EQ(Found::kOutOfReach, foundAt(-1485.2f, 1066.6f));
  EXPECT_EQ(Found::kOutOfReach, foundAt(-1400, 1000));  // nearer than the ring is wide
}

TEST(BadInput, WithoutARingTheBitStaysOutOfTheSprocket) {
  Tried tried;
  tried.rotation_radius = 0;
  const Machine<float> bare = lawsOf<float>(tried);
  EXPECT_EQ(Found::kOutOfReach, inverse(bare, Point<float>{-1484.2f, 1065.6f}).found);
}

TEST(BadInput, LengthsThatAreNaN) {
  EXPECT_EQ(Found::kOutOfReach, foundFor(kNan, 1500));
  EXPECT_EQ(Found::kOutOfReach, foundFor(1500, kNan));
  EXPECT_EQ(Found::kOutOfReach, foundFor(INFINITY, 1500));
  EXPECT_EQ(Found::kOutOfReach, foundFor(1e30f, 1e30f));
}

TEST(BadInput, ANaNAsAGuessDoesNotSpoilTheSearch) {
  const Chains<float> chains = inverse(machine(), Point<float>{200, -300}).chains;
  const Place<float> place = forward(machine(), chains, Point<float>{kNan, INFINITY});
  ASSERT_EQ(Found::kYes, place.found);
  EXPECT_NEAR(200, place.sled.x, 0.01);
  EXPECT_NEAR(-300, place.sled.y, 0.01);
}

TEST(BadInput, FoundPlacesGiveBackTheirChains) {
  // Any pair of lengths is either refused, or gives a place that needs exactly these lengths.
  const Machine<float> here = machine();
  int found = 0, refused = 0;
  for (float left = 0; left < 5000; left += 83)
    for (float right = 0; right < 5000; right += 83) {
      const Place<float> place = forward(here, Chains<float>{left, right});
      if (place.found != Found::kYes) {
        ++refused;
        continue;
      }
      ++found;
      const PaidOut<float> back = inverse(here, place.sled);
      ASSERT_EQ(Found::kYes, back.found) << left << " " << right;
      EXPECT_NEAR(left, back.chains.left, 0.1) << left << " " << right;
      EXPECT_NEAR(right, back.chains.right, 0.1) << left << " " << right;
    }
  EXPECT_GT(found, 500);
  EXPECT_GT(refused, 500);
}

TEST(BadInput, PlacesAlmostUnderAMotor) {
  for (double gap = 2400; gap < 2480; gap += 4) {
    Tried narrow = triedMachines()[0];
    narrow.motor_gap = gap;
    const Machine<float> laws = lawsOf<float>(narrow);
    for (float x = 1150; x < 1240; x += 0.25f)
      for (const float y : {-600.0f, 0.0f, 600.0f}) {
        const PaidOut<float> paid = inverse(laws, Point<float>{x, y});
        if (paid.found != Found::kYes) continue;
        const float straight = hypotf(x + float(gap) / 2, laws.frame.motor_height - y);
        EXPECT_NEAR(straight, paid.chains.left, 400) << gap << " " << x << " " << y;
      }
  }
}
