// Set-points inside a segment are the exact quadratic, rounded; and the bound of how far it is from
// the exact inverse holds.
#include <gtest/gtest.h>

#include "machines.h"

using namespace motion;

namespace {

/// The quadratic through three lengths, from whole numbers without any remainder dropped.
double quadratic(int64_t from, int64_t middle, int64_t to, int64_t t, int64_t n) {
  const int64_t bend = 2 * (from - 2 * middle + to), slope = to - from - bend;
  return double(from) + double(slope * t * n + bend * t * t) / double(n * n);
}

int64_t inLastDigits(Fine number) { return number.whole * 65536LL + number.fraction; }

struct Three {
  int32_t from, middle, to;
};

/// Lengths up to 8191 mm that rise by up to `most` [counts] in each half.
Three randomThree(std::mt19937& random, int32_t most) {
  std::uniform_int_distribution<int32_t> any(-536000000, 536000000), rise(-most, most);
  const int32_t from = any(random), middle = from + rise(random) / 2;
  return {from, middle, middle + rise(random) / 2};
}

}  // namespace

TEST(Segment, EverySetPointIsTheQuadraticRounded) {
  std::mt19937 random(5);
  for (int ticks = 1; ticks <= kMostTicks; ++ticks)
    for (int32_t most : {300, 70000, 3000000, kMostRise - 1}) {
      const Three at = randomThree(random, most);
      Steps steps = stepsThrough(at.from, at.middle, at.to, uint8_t(ticks));
      for (int t = 1; t <= ticks; ++t) {
        steps.advance();
        const double exact = quadratic(at.from, at.middle, at.to, t, ticks);
        ASSERT_NEAR(exact, steps.length.whole, 0.57) << "tick " << t << " of " << ticks;
      }
    }
}

TEST(Segment, EndsOnItsLastKnotToTheCount) {
  std::mt19937 random(6);
  for (int i = 0; i < 20000; ++i) {
    const Three left = randomThree(random, 5000000), right = randomThree(random, 5000000);
    const uint8_t ticks = uint8_t(1 + i % kMostTicks);
    Segment segment = segmentThrough({left.from, right.from}, {left.middle, right.middle},
                                     {left.to, right.to}, ticks);
    EXPECT_EQ(left.from, segment.left.length.whole);
    EXPECT_EQ(right.from, segment.right.length.whole);
    while (segment.ticks_left > 0) segment.advance();
    ASSERT_EQ(left.to, segment.left.length.whole);
    ASSERT_EQ(right.to, segment.right.length.whole);
  }
}

TEST(Segment, PassesThroughItsMiddleKnot) {
  std::mt19937 random(7);
  for (int half = 1; half <= kMostTicks / 2; ++half) {
    const Three at = randomThree(random, 3000000);
    Steps steps = stepsThrough(at.from, at.middle, at.to, uint8_t(2 * half));
    for (int t = 0; t < half; ++t) steps.advance();
    ASSERT_EQ(at.middle, steps.length.whole);
  }
}

TEST(Fine, DivisionRoundsDownOnBothSidesOfZero) {
  for (int32_t dividend : {-700, -13, -7, -1, 0, 1, 6, 7, 700, 2000000000, -2000000000})
    for (uint16_t divisor : {1, 7, 181, 32761}) {
      const int64_t quotient = inLastDigits(divide(dividend, divisor));
      const int64_t left = dividend * 65536LL - quotient * divisor;
      EXPECT_GE(left, 0) << dividend << " / " << divisor;
      EXPECT_LT(left, divisor) << dividend << " / " << divisor;
    }
}

TEST(Fine, SumsDifferencesAndHalvesCarryBetweenTheirParts) {
  for (Fine first : {Fine{0, 0}, Fine{5, 0xFFFF}, Fine{-7, 1}, Fine{-1, 0x8000}, Fine{100000, 3}})
    for (Fine other : {Fine{0, 1}, Fine{-3, 0xFFFF}, Fine{12, 0x8001}}) {
      EXPECT_EQ(inLastDigits(first) - inLastDigits(other),
                inLastDigits(differenceOf(first, other)));
      for (uint8_t factor : {0, 1, 2, 179, 180}) {
        const int64_t twice = 2 * inLastDigits(timesHalf(other, factor));
        const int64_t exact = inLastDigits(other) * factor;
        EXPECT_TRUE(twice == exact || twice == exact - 1) << twice << " for " << exact;
      }
      Fine sum = first;
      add(sum, other);
      EXPECT_EQ(inLastDigits(first) + inLastDigits(other), inLastDigits(sum));
    }
}

TEST(Counts, RoundToTheNearest) {
  EXPECT_EQ(65536, toCounts(1.0));
  EXPECT_EQ(-65536 * 6000, toCounts(-6000.0f));
  EXPECT_EQ(1, toCounts(0.6 / kCountsPerMm));
  EXPECT_DOUBLE_EQ(6000.5, toMm<double>(toCounts(6000.5)));
}

TEST(Counts, RefuseLengthsThatAreTooLongOrNaN) {
  const Point<double> anywhere = {0, 0};
  for (double bad : {8191.5, -9000.0, 1e300, double(INFINITY), nan("")}) {
    const auto left = [bad](Point<double>) { return Lengths<double>{bad, 1, true}; };
    const auto right = [bad](Point<double>) { return Lengths<double>{1, bad, true}; };
    EXPECT_FALSE(knotAt(left, anywhere).reachable) << bad;
    EXPECT_FALSE(knotAt(right, anywhere).reachable) << bad;
  }
  const auto fine = [](Point<double>) { return Lengths<double>{8190, 2, true}; };
  EXPECT_TRUE(knotAt(fine, anywhere).reachable);
  EXPECT_EQ(8190 * kCountsPerMm, knotAt(fine, anywhere).knot.left);
}

namespace {

class BoundOf : public testing::TestWithParam<Tried> {};
INSTANTIATE_TEST_SUITE_P(Machines, BoundOf, testing::ValuesIn(triedMachines()), NameOfTried());

const Slopes<double> kNoEffects = {0, 0, 0};

/// The larger third slope [1/mm^2] of both chains in the middle of a path.
template <class Inverse>
double thirdSlopeOf(const Path<double>& path, const Inverse& inverse) {
  const double step = fmin(4.0, path.length / 8), share = step / path.length;
  Lengths<double> at[5];
  for (int i = 0; i < 5; ++i) at[i] = inverse(placeOn(path, 0.5 + (i - 2) * share));
  const double left = at[4].left - 2 * at[3].left + 2 * at[1].left - at[0].left;
  const double right = at[4].right - 2 * at[3].right + 2 * at[1].right - at[0].right;
  return fmax(fabs(left), fabs(right)) / (2 * step * step * step);
}

/// Distances from the sprockets, nothing else.
struct Distances {
  Point<double> left, right;
  Lengths<double> operator()(Point<double> at) const {
    return {hypot(at.x - left.x, at.y - left.y), hypot(at.x - right.x, at.y - right.y), true};
  }
};

/// A piece of 40 mm of a line or a fifth of a turn of an arc, somewhere on the sheet.
Path<double> piece(Paths& paths, bool straight) {
  for (;;) {
    const Point<double> from = paths.place();
    const double heading = paths.between(0, 6.2831853);
    const double radius = exp(paths.between(log(1.0), log(600.0)));
    const Point<double> centre = {from.x + radius * cos(heading), from.y + radius * sin(heading)};
    const double turned = heading + 3.14159265 + 1.2;
    const Point<double> end = {centre.x + radius * cos(turned), centre.y + radius * sin(turned)};
    const Point<double> ahead = {from.x + 40 * cos(heading), from.y + 40 * sin(heading)};
    if (!Paths::onSheet(straight ? ahead : end)) continue;
    return straight ? line(from, ahead) : arc(from, end, centre, Turn::kCounterclockwise);
  }
}

}  // namespace

TEST(Bound, OnTheDistanceIsTightAndNeverExceeded) {
  const Tried tried = triedMachines()[0];
  const Distances distances = {sprocketOf(tried, 0), sprocketOf(tried, 1)};
  double straight = 0, turning = 0;
  Paths paths(8);
  for (int i = 0; i < 60000; ++i) {
    const Path<double> path = piece(paths, i % 2 != 0);
    const Lengths<double> at = distances(placeOn(path, 0.5));
    const double bound = thirdSlope(path.curvature(), {fmin(at.left, at.right), kNoEffects});
    const double share = thirdSlopeOf(path, distances) / bound;
    double& most = path.sweep == 0 ? straight : turning;
    most = fmax(most, share);
  }
  EXPECT_LT(straight, 1.005);
  EXPECT_GT(straight, 0.99);
  EXPECT_LT(turning, 1.0);
  EXPECT_GT(turning, 0.8);
}

TEST(Bound, AddsTheMaximaOfAllTerms) {
  // By hand, a distance of 100 mm: 2 / sqrt 3 / 100^2 and 0.5e-4 of effects; then an arc of 50 mm.
  const Surroundings<double> around = {100, {0.1, 0.002, 0.5e-4}};
  EXPECT_NEAR(1.1547e-4 + 0.5e-4, thirdSlope(0.0, around), 1e-9);
  const double turning = 0.02 * 1.5 / 100 + 3 * 0.02 * 0.002, bent = 4e-4 * (1 + 0.1);
  EXPECT_NEAR((1.1547e-4 + 0.5e-4 + turning + bent) * double(kSpiralMargin),
              thirdSlope(0.02, around), 1e-8);
}

TEST_P(BoundOf, IsNeverExceededByTheExactInverse) {
  const Tried tried = GetParam();
  const Exactly<double> exact = exactly<double>(tried);
  const Distances distances = {sprocketOf(tried, 0), sprocketOf(tried, 1)};
  const Slopes<double> effects = effectsOf(tried);
  double most = 0;
  Paths paths(9);
  for (int i = 0; i < 40000; ++i) {
    const Path<double> path = piece(paths, i % 2 != 0);
    const Lengths<double> at = distances(placeOn(path, 0.5));
    const double bound = thirdSlope(path.curvature(), {fmin(at.left, at.right), effects});
    most = fmax(most, thirdSlopeOf(path, exact) / bound);
  }
  RecordProperty("largest_share_of_bound", std::to_string(most));
  EXPECT_LT(most, 1);
  EXPECT_GT(most, 0.4);
}

TEST(Bound, LongestTimeAtConstantSpeedIsExactForACubic) {
  // f = third / 6 * s^3; the error of its quadratic is largest at (1 - 1/sqrt 3) / 2.
  for (double third : {1e-6, 1e-4, 0.1, 100.0})
    for (double speed : {0.01, 0.15, 3.0}) {
      const double time = longestTime(third, 0.5, speed, 0.0);
      const double length = time * speed, at = length * (0.5 - 0.5 / sqrt(3.0));
      const double missed = third / 6 * at * (at - length / 2) * (at - length);
      EXPECT_NEAR(double(kMostMissed), missed, 1e-8);
    }
}

TEST(Bound, IsReachedByALengthThatCurvesUnderAcceleration) {
  // L = s^2 / 2 has the second slope 1; with s = a t^2 / 2 it is a^2 t^4 / 8, whose third slope
  // 3 a^2 t is 3 * 1 * speed * a. For a short time at a high speed this is nearly a cubic.
  const double a = 0.01, t = 100, half = 0.5 * longestTime(0.0, 1.0, a * t, a);
  const auto length = [&](double time) { return a * a * pow(t + time, 4) / 8; };
  const double at = -half / sqrt(3.0), u = at / half;
  const double quadratic =
      length(-half) * u * (u - 1) / 2 + length(0) * (1 - u * u) + length(half) * u * (u + 1) / 2;
  EXPECT_NEAR(double(kMostMissed), fabs(length(at) - quadratic), 0.02 * double(kMostMissed));
}

TEST(Bound, OfTheSecondSlopeCoversDistanceAndEffects) {
  const Surroundings<double> around = {100, {0.1, 0.002, 0}};
  EXPECT_NEAR(0.01 + 0.002, secondSlope(0.0, around), 1e-12);
  EXPECT_NEAR(0.01 + 0.002 + 0.02 * 1.1, secondSlope(0.02, around), 1e-12);
}
