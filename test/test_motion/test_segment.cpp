// Set-points inside a segment are the exact quadratic, rounded: no rounding adds up.
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
