// A path is cut into ticks of one length and into segments short enough for the bound.
#include <gtest/gtest.h>

#include "machines.h"

using namespace motion;

namespace {

typedef Point<double> Spot;

const Surroundings<double> kFar = {1000, {0, 0, 0}};
const double kNan = nan("");

Path<double> lineOf(double length) { return line(Spot{0, 0}, Spot{length, 0}); }

Outcome outcomeOf(const Path<double>& path, double step, const Surroundings<double>& around) {
  return beginCutting(path, step, around).outcome;
}

/// Chains without a sled: as long as the place's coordinates, counting how often it is asked.
struct Counting {
  int* asked;
  Lengths<double> operator()(Spot at) const {
    ++*asked;
    return {1000 + at.x, 1000 - at.x, true};
  }
};

}  // namespace

TEST(Segmenter, TicksFitTheLengthAndAreNeverLongerThanTheStep) {
  EXPECT_EQ(100, beginCutting(lineOf(15), 0.15, kFar).ticks);
  EXPECT_EQ(101, beginCutting(lineOf(15.001), 0.15, kFar).ticks);
  EXPECT_EQ(1, beginCutting(lineOf(0.001), 0.15, kFar).ticks);
  Paths paths(10);
  for (int i = 0; i < 2000; ++i) {
    const Path<double> path = i % 2 ? paths.line() : paths.arc();
    const double step = paths.between(0.001, 2);
    EXPECT_LE(path.length / beginCutting(path, step, kFar).ticks, step * (1 + 1e-12));
  }
}

TEST(Segmenter, AsksTheExactInverseTwiceForASegmentAndOnceForASingleTick) {
  int asked = 0;
  const Counting inverse = {&asked};
  Cutting<double> cutting = beginCutting(lineOf(0.45), 0.15, kFar);
  const Cut cut = cutNext(cutting, Knot{toCounts(1000.0), toCounts(1000.0)}, inverse);
  EXPECT_EQ(3, cut.segment.ticks_left);
  EXPECT_EQ(2, asked);
  cutting = beginCutting(lineOf(0.1), 0.15, kFar);
  EXPECT_EQ(1,
            cutNext(cutting, Knot{toCounts(1000.0), toCounts(1000.0)}, inverse).segment.ticks_left);
  EXPECT_EQ(3, asked);
}

TEST(Segmenter, AskedOnceMoreThanTwicePerSegmentOnlyByTheCaller) {
  int asked = 0;
  const Counting inverse = {&asked};
  PathFollower<double> follower(Knot{toCounts(1000.0), toCounts(1000.0)});
  ASSERT_EQ(Outcome::kMoving, follower.follow(lineOf(150), 0.15, kFar));
  int ticks = 0;
  while (follower.tick(inverse) == Outcome::kMoving) ++ticks;
  EXPECT_EQ(1000, ticks);
  EXPECT_EQ(2 * 6, asked);  // 1000 ticks are six segments of at most 181
}

TEST(Segmenter, SegmentsObeyTheBoundOnceTheyHaveMoreThanTwoTicks) {
  Paths paths(11);
  for (int i = 0; i < 4000; ++i) {
    const Path<double> path = i % 2 ? paths.line() : paths.arc();
    const Surroundings<double> around = {paths.between(200, 2000), {0.1, 0.0003, 1e-5}};
    const Cutting<double> cutting = beginCutting(path, paths.between(0.01, 5), around);
    ASSERT_EQ(Outcome::kMoving, cutting.outcome);
    ASSERT_GE(cutting.per_segment, 2);
    ASSERT_LE(cutting.per_segment, kMostTicks);
    const double ticks = fmin(cutting.per_segment, cutting.ticks);
    const double segment = ticks * path.length / cutting.ticks;
    const double most = missed(thirdSlope(path.curvature(), around), segment);
    if (cutting.per_segment > 2) {
      ASSERT_LE(most, double(kMostMissed) * 1.000001);
    }
    // Nor are they needlessly short.
    const bool capped = cutting.per_segment == kMostTicks;
    if (!capped && cutting.per_segment > 20) {
      ASSERT_GE(most, double(kMostMissed) * 0.85);
    }
  }
}

TEST(Segmenter, NearerSprocketsAndTighterArcsMakeShorterSegments) {
  const Slopes<double> none = {0, 0, 0};
  const Path<double> path = lineOf(400);
  const Path<double> wide = arc(Spot{100, 0}, Spot{100, 0}, Spot{0, 0}, Turn::kClockwise);
  const Path<double> tight = arc(Spot{10, 0}, Spot{10, 0}, Spot{0, 0}, Turn::kClockwise);
  const auto most = [&](const Path<double>& on, double nearest) {
    const Surroundings<double> around = {nearest, none};
    return int(beginCutting(on, 1.0, around).per_segment);
  };
  EXPECT_GT(most(path, 1500), most(path, 600));
  EXPECT_GT(most(path, 600), most(path, 300));
  EXPECT_GT(most(path, 600), most(wide, 600));
  EXPECT_GT(most(wide, 600), most(tight, 600));
}

TEST(Segmenter, NoSegmentIsSoLongThatCountsOverflow) {
  const Surroundings<double> nowhere = {1e7, {0, 0, 0}};
  EXPECT_EQ(25, beginCutting(lineOf(1000), 10.0, nowhere).per_segment);
  EXPECT_EQ(2, beginCutting(lineOf(1000), 100.0, nowhere).per_segment);
}

TEST(Segmenter, NeverMakesThreeTicksWhereTheBoundIsTight) {
  const double longest = longestSegment(thirdSlope(0.0, kFar));
  const auto most = [&](double ticks) {
    return int(beginCutting(lineOf(200), longest / ticks, kFar).per_segment);
  };
  EXPECT_EQ(2, most(1.5));
  EXPECT_EQ(2, most(3.5));
  EXPECT_EQ(4, most(4.2));
  EXPECT_EQ(5, most(5.2));
}

TEST(Segmenter, RefusesStepsThatAreNone) {
  const Path<double> path = lineOf(10);
  for (double step : {0.0, -0.15, kNan, -double(INFINITY)})
    EXPECT_EQ(Outcome::kNoFeed, outcomeOf(path, step, kFar)) << step;
  for (double step : {100.1, 1e30, double(INFINITY)})
    EXPECT_EQ(Outcome::kTooFast, outcomeOf(path, step, kFar)) << step;
  EXPECT_EQ(Outcome::kMoving, outcomeOf(path, 100, kFar));
  EXPECT_EQ(Outcome::kTooSlow, outcomeOf(path, 1e-7, kFar));
  EXPECT_EQ(Outcome::kTooSlow, outcomeOf(path, 1e-300, kFar));
}

TEST(Segmenter, RefusesAPathThatWasNotDrawn) {
  EXPECT_EQ(Outcome::kNoPath, outcomeOf(lineOf(0), 0.15, kFar));
  EXPECT_EQ(Outcome::kNoPath, outcomeOf(lineOf(kNan), 0.15, kFar));
}

TEST(Segmenter, RefusesSurroundingsThatBoundNothing) {
  const Path<double> path = lineOf(10);
  for (double bad : {0.0, -1.0, kNan})
    EXPECT_EQ(Outcome::kNoBound, outcomeOf(path, 0.15, {bad, {0, 0, 0}})) << bad;
  for (double bad : {-1.0, kNan, double(INFINITY)}) {
    EXPECT_EQ(Outcome::kNoBound, outcomeOf(path, 0.15, {500, {bad, 0, 0}})) << bad;
    EXPECT_EQ(Outcome::kNoBound, outcomeOf(path, 0.15, {500, {0, bad, 0}})) << bad;
    EXPECT_EQ(Outcome::kNoBound, outcomeOf(path, 0.15, {500, {0, 0, bad}})) << bad;
  }
}
