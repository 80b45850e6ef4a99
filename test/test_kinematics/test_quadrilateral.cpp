// The sled with two brackets: lengths and tilt against exact statics, and the way back.
#include <gtest/gtest.h>
#include <math.h>
#include <quadrilateral.h>

#include <random>

#include "machines.h"
#include "reference/two_brackets.h"

using namespace kinematics;

namespace {

/// A bracketed sled on its machine, in plain numbers.
struct TriedSled {
  const char* name;
  double mount_gap = 310, mount_height = 139, center_depth = 79;  // [mm]
  double motor_gap = 2978.4, motor_offset = 463;                  // [mm]
  bool over_top = true;
  double left_pitch = 0.0012, right_pitch = 0.0004;
};

std::vector<TriedSled> triedSleds() {
  return {
      {"Published"},
      {"OffBottom", 310, 139, 79, 2978.4, 463, false},
      {"NarrowFlatShallow", 240, 100, 30},
      {"NarrowFlatDeep", 240, 100, 150},
      {"NarrowHighShallow", 240, 180, 30},
      {"NarrowHighDeep", 240, 180, 150},
      {"WideFlatShallow", 340, 100, 30},
      {"WideFlatDeep", 340, 100, 150},
      {"WideHighShallow", 340, 180, 30},
      {"WideHighDeepOffBottom", 340, 180, 150, 2978.4, 463, false},
      {"LowMotors", 340, 180, 30, 2900, 300},
      {"LowMotorsOffBottom", 340, 100, 30, 2900, 300, false},
      {"LowWideMotorsOffBottom", 240, 180, 30, 3700, 300, false},
      {"HighMotors", 340, 100, 150, 2900, 900},
      {"HighWideMotors", 310, 139, 79, 3700, 900},
  };
}

template <class Real>
Quadrilateral<Real> lawsOf(const TriedSled& tried) {
  Frame<Real> frame = {};
  frame.motor_gap = Real(tried.motor_gap);
  frame.motor_height = Real(kHalfHeight + tried.motor_offset);
  frame.sprocket_radius = Real(kSprocketRadius);
  frame.feed = tried.over_top ? Feed::kOverTop : Feed::kOffBottom;
  const BracketSled<Real> sled = {Real(tried.mount_gap), Real(tried.mount_height),
                                  Real(tried.center_depth)};
  return prepare(frame, sled, PitchStrain<Real>{Real(tried.left_pitch), Real(tried.right_pitch)});
}

reference::TiltedHang judged(const TriedSled& tried, Point<double> bit) {
  reference::Machine machine;
  machine.motor_gap = tried.motor_gap;
  machine.motor_height = kHalfHeight + tried.motor_offset;
  machine.sprocket_radius = kSprocketRadius;
  machine.over_top = tried.over_top;
  machine.left.pitch = tried.left_pitch;
  machine.right.pitch = tried.right_pitch;
  return reference::hangTilted(machine, {tried.mount_gap, tried.mount_height, tried.center_depth},
                               {bit.x, bit.y});
}

template <class Real>
double miss(const TiltedPlace<Real>& place, Point<Real> target) {
  return hypot(double(place.sled.x - target.x), double(place.sled.y - target.y));
}

/// Larger difference [mm] of both lengths.
template <class First, class Second>
double apart(Chains<First> first, Chains<Second> second) {
  return fmax(fabs(double(first.left) - double(second.left)),
              fabs(double(first.right) - double(second.right)));
}

Quadrilateral<float> published() { return lawsOf<float>(triedSleds()[0]); }

Found foundTilted(float x, float y) {
  const TiltedPaidOut<float> paid = inverse(published(), Point<float>{x, y});
  const TiltedPaidOut<float> level = inverse(published(), Point<float>{x, y}, 0.0f);
  EXPECT_EQ(paid.found, level.found);
  for (const TiltedPaidOut<float>& answer : {paid, level})
    if (answer.found != Found::kYes) {
      EXPECT_EQ(0, answer.chains.left);
      EXPECT_EQ(0, answer.chains.right);
    }
  return paid.found;
}

Found foundTiltedFor(float left, float right) {
  return forward(published(), Chains<float>{left, right}).found;
}

}  // namespace

inline void PrintTo(const TriedSled& tried, std::ostream* out) { *out << tried.name; }

class EverySled : public testing::TestWithParam<TriedSled> {};
INSTANTIATE_TEST_SUITE_P(Quadrilateral, EverySled, testing::ValuesIn(triedSleds()), NameOfTried());

TEST_P(EverySled, LengthsAndTiltAgreeWithExactStatics) {
  const Quadrilateral<double> machine = lawsOf<double>(GetParam());
  for (const Point<double>& place : sheetPlaces<double>()) {
    const TiltedPaidOut<double> paid = inverse(machine, place);
    const reference::TiltedHang truth = judged(GetParam(), place);
    ASSERT_TRUE(truth.solved);
    ASSERT_EQ(Found::kYes, paid.found) << place.x << " " << place.y;
    EXPECT_LT(apart(paid.chains, Chains<double>{truth.paid_out[0], truth.paid_out[1]}), 0.004)
        << place.x << " " << place.y;
    EXPECT_NEAR(truth.tilt, asin(paid.tilt_sine), 1e-5) << place.x << " " << place.y;
    EXPECT_LE(paid.tries, 3);
  }
}

TEST_P(EverySled, FloatAgreesWithDouble) {
  const Quadrilateral<float> single = lawsOf<float>(GetParam());
  const Quadrilateral<double> twice = lawsOf<double>(GetParam());
  for (const Point<float>& place : sheetPlaces<float>()) {
    const TiltedPaidOut<float> rounded = inverse(single, place);
    const TiltedPaidOut<double> exact = inverse(twice, Point<double>{place.x, place.y});
    ASSERT_EQ(Found::kYes, rounded.found);
    EXPECT_LT(apart(rounded.chains, exact.chains), 0.0012);
  }
}

TEST_P(EverySled, AnyGuessOfTheTiltGivesTheSameLengths) {
  const Quadrilateral<float> machine = lawsOf<float>(GetParam());
  for (const Point<float>& place : sheetPlaces<float>(10, 17, 9)) {
    const TiltedPaidOut<float> paid = inverse(machine, place);
    for (float guess : {-0.9f, -0.4f, 0.0f, 0.4f, 0.9f, 3.0f, nanf("")}) {
      const TiltedPaidOut<float> other = inverse(machine, place, guess);
      ASSERT_EQ(Found::kYes, other.found) << "from " << guess;
      EXPECT_LT(apart(paid.chains, other.chains), 0.002) << "from " << guess;
    }
  }
}

TEST_P(EverySled, TheTiltOfANearbyPlaceSavesAnIteration) {
  const Quadrilateral<float> machine = lawsOf<float>(GetParam());
  for (const Point<float>& place : sheetPlaces<float>(10, 17, 9)) {
    const TiltedPaidOut<float> paid = inverse(machine, place);
    const Point<float> next = {place.x + 0.1f, place.y - 0.1f};
    EXPECT_EQ(1, inverse(machine, next, paid.tilt_sine).tries) << place.x << " " << place.y;
  }
}

TEST_P(EverySled, ForwardFindsThePlaceWithoutAGuess) {
  const Quadrilateral<float> machine = lawsOf<float>(GetParam());
  for (const Point<float>& target : sheetPlaces<float>()) {
    const TiltedPaidOut<float> paid = inverse(machine, target);
    const TiltedPlace<float> place = forward(machine, paid.chains);
    ASSERT_EQ(Found::kYes, place.found) << target.x << " " << target.y;
    EXPECT_LT(miss(place, target), kCloseEnough) << target.x << " " << target.y;
    EXPECT_NEAR(paid.tilt_sine, place.tilt_sine, 1e-4);
    EXPECT_LE(place.tries, 6);
  }
}

TEST_P(EverySled, ForwardComesBackFromTwiceTheSheetAndAnyTilt) {
  const Quadrilateral<float> machine = lawsOf<float>(GetParam());
  std::mt19937 random(20200501);
  std::uniform_real_distribution<float> across(-2438.4f, 2438.4f), along(-1219.2f, 1219.2f);
  std::uniform_real_distribution<float> tilt(-1, 1);
  for (const Point<float>& target : sheetPlaces<float>(10, 17, 9))
    for (int i = 0; i < 10; ++i) {
      const Point<float> guess = {across(random), along(random)};
      const TiltedPlace<float> place =
          forward(machine, inverse(machine, target).chains, guess, tilt(random));
      ASSERT_EQ(Found::kYes, place.found)
          << "from " << guess.x << " " << guess.y << " to " << target.x << " " << target.y;
      EXPECT_LT(miss(place, target), kCloseEnough) << "from " << guess.x << " " << guess.y;
    }
}

TEST(Quadrilateral, ForwardFollowsASmallStepInOneIteration) {
  const Quadrilateral<float> machine = published();
  const Point<float> target = {850, -420}, guess = {850.05f, -420.03f};
  const TiltedPaidOut<float> paid = inverse(machine, target);
  const TiltedPlace<float> place = forward(machine, paid.chains, guess, paid.tilt_sine);
  EXPECT_EQ(1, place.tries);
  EXPECT_LT(miss(place, target), 0.002);
}

TEST(Quadrilateral, StepsSmoothlyInFloat) {
  const Quadrilateral<float> single = published();
  const Quadrilateral<double> twice = lawsOf<double>(triedSleds()[0]);
  TiltedPaidOut<float> paid = inverse(single, Point<float>{600, -500});
  TiltedPaidOut<double> exact = inverse(twice, Point<double>{600, -500});
  double worst = 0;
  for (int i = 1; i < 4000; ++i) {
    const Point<float> place = {600 + 0.15f * float(i), -500 + 0.01f * float(i)};
    const Chains<float> before = paid.chains;
    const Chains<double> exact_before = exact.chains;
    paid = inverse(single, place, paid.tilt_sine);
    exact = inverse(twice, Point<double>{place.x, place.y}, exact.tilt_sine);
    worst =
        fmax(worst,
             apart(Chains<float>{paid.chains.left - before.left, paid.chains.right - before.right},
                   Chains<double>{exact.chains.left - exact_before.left,
                                  exact.chains.right - exact_before.right}));
  }
  EXPECT_LT(worst, 0.0015);
}

TEST(Quadrilateral, RefusesPlacesThatAreNaN) {
  EXPECT_EQ(Found::kOutOfReach, foundTilted(nanf(""), 0));
  EXPECT_EQ(Found::kOutOfReach, foundTilted(0, nanf("")));
  EXPECT_EQ(Found::kOutOfReach, foundTilted(INFINITY, 0));
  EXPECT_EQ(Found::kOutOfReach, foundTilted(0, -INFINITY));
  EXPECT_EQ(Found::kOutOfReach, foundTilted(1e30f, -1e30f));
}

TEST(Quadrilateral, RefusesPlacesOutOfReachWithoutSearching) {
  for (const Point<float>& place :
       {Point<float>{0, 1500}, {1600, 0}, {-1480, -500}, {nanf(""), nanf("")}})
    EXPECT_EQ(1, inverse(published(), place).tries) << place.x << " " << place.y;
}

TEST(Quadrilateral, EveryPlaceIsRefusedOrHasTautChains) {
  const Quadrilateral<double> machine = lawsOf<double>(triedSleds()[0]);
  int found = 0, refused = 0;
  for (double x = -1700; x <= 1700; x += 25)
    for (double y = -2000; y <= 1400; y += 25) {
      const TiltedPaidOut<double> paid = inverse(machine, Point<double>{x, y});
      if (paid.found != Found::kYes) {
        // With its brackets next to a sprocket the search may also give up.
        EXPECT_TRUE(paid.found == Found::kOutOfReach || y > 850) << x << " " << y;
        ++refused;
        continue;
      }
      ++found;
      const reference::TiltedHang truth = judged(triedSleds()[0], {x, y});
      ASSERT_TRUE(truth.solved) << x << " " << y;
      EXPECT_LT(apart(paid.chains, Chains<double>{truth.paid_out[0], truth.paid_out[1]}), 0.02)
          << x << " " << y;
    }
  EXPECT_GT(found, 10000);
  EXPECT_GT(refused, 2000);
}

TEST(Quadrilateral, RefusesChainsThatCannotHoldIt) {
  EXPECT_EQ(Found::kOutOfReach, foundTiltedFor(1000, 1000));  // too short to meet
  EXPECT_EQ(Found::kOutOfReach, foundTiltedFor(0, 0));
  EXPECT_EQ(Found::kOutOfReach, foundTiltedFor(-500, 100));
  EXPECT_NE(Found::kYes, foundTiltedFor(300, 4000));  // all on one motor
  EXPECT_NE(Found::kYes, foundTiltedFor(5000, 500));
  EXPECT_EQ(Found::kOutOfReach, foundTiltedFor(nanf(""), 1500));
  EXPECT_EQ(Found::kOutOfReach, foundTiltedFor(1500, nanf("")));
  EXPECT_EQ(Found::kOutOfReach, foundTiltedFor(INFINITY, 1500));
  EXPECT_EQ(Found::kOutOfReach, foundTiltedFor(1e30f, 1e30f));
}

TEST(Quadrilateral, RefusesASledThatWouldTopple) {
  const Frame<double> frame = {2978.4, 1072.6, 0, 0, kSprocketRadius, 0, 0, Feed::kOverTop};
  const Quadrilateral<double> safe = lawsOf<double>(triedSleds()[0]);
  const Chains<double> chains = inverse(safe, Point<double>{0, 0}).chains;
  for (const BracketSled<double>& sled :
       {BracketSled<double>{310, 139, -139}, BracketSled<double>{310, 139, -500},
        BracketSled<double>{0, 139, 79}, BracketSled<double>{310, 139, NAN}}) {
    const Quadrilateral<double> machine = prepare(frame, sled, PitchStrain<double>{0, 0});
    EXPECT_EQ(Found::kOutOfReach, inverse(machine, Point<double>{0, 0}).found);
    EXPECT_EQ(Found::kOutOfReach, inverse(machine, Point<double>{0, 0}, 0.0).found);
    EXPECT_EQ(Found::kOutOfReach, forward(machine, chains).found);
    EXPECT_EQ(Found::kOutOfReach, forward(machine, chains, Point<double>{0, 0}, 0.0).found);
  }
}

TEST(Quadrilateral, ANaNAsAGuessDoesNotSpoilTheSearch) {
  const Chains<float> chains = inverse(published(), Point<float>{200, -300}).chains;
  const TiltedPlace<float> place =
      forward(published(), chains, Point<float>{nanf(""), INFINITY}, nanf(""));
  ASSERT_EQ(Found::kYes, place.found);
  EXPECT_LT(miss(place, Point<float>{200, -300}), kCloseEnough);
}

TEST(Quadrilateral, FoundPlacesGiveBackTheirChains) {
  const Quadrilateral<float> machine = published();
  int found = 0, refused = 0;
  for (float left = 0; left < 5000; left += 83)
    for (float right = 0; right < 5000; right += 83) {
      const TiltedPlace<float> place = forward(machine, Chains<float>{left, right});
      EXPECT_LE(place.tries, 20);
      if (place.found != Found::kYes) {
        ++refused;
        continue;
      }
      ++found;
      const TiltedPaidOut<float> back = inverse(machine, place.sled);
      ASSERT_EQ(Found::kYes, back.found) << left << " " << right;
      EXPECT_LT(apart(back.chains, Chains<float>{left, right}), 0.1) << left << " " << right;
    }
  EXPECT_GT(found, 500);
  EXPECT_GT(refused, 500);
}
