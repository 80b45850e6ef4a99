// Every set-point against the exact inverse in double: error, jitter, drift, and where it stops.
#include <gtest/gtest.h>

#include "machines.h"

using namespace motion;

namespace {

class Follower : public testing::TestWithParam<Tried> {};
INSTANTIATE_TEST_SUITE_P(Machines, Follower, testing::ValuesIn(triedMachines()), NameOfTried());

const double kStep = 0.15;  // [mm] 900 mm/min in ticks of 10 ms

// [mm] Each knot is rounded by half a count, which a quadratic makes 5/8, and the set-point by
// 0.57.
const double kRounding = (0.625 + 0.57) / kCountsPerMm;

struct Worst {
  double error = 0;   // [mm]
  double over = -1;   // [mm] error beyond the derived bound
  double jitter = 0;  // [mm] of the difference between successive set-points
  long set_points = 0;
  long segments = 0;
};

/// Follows one path and holds every tick against the exact inverse along the exact path.
template <class Real>
void follow(const Tried& tried, const Exactly<double>& judge, const Exactly<Real>& own,
            const Path<double>& path, double step, Worst& worst) {
  const Path<Real> walked = as<Real>(path);
  const Surroundings<Real> surroundings = around(tried, walked);
  const Cutting<Real> cutting = beginCutting(walked, Real(step), surroundings);
  const double segment = path.length * fmin(1.0, double(cutting.per_segment) / cutting.ticks);
  const double may = cutting.per_segment > 2
                         ? missed(thirdSlope(path.curvature(), around(tried, path)), segment)
                         : 0.0;
  PathFollower<Real> follower(knotAt(own, walked.from).knot);
  ASSERT_EQ(Outcome::kMoving, follower.follow(walked, Real(step), surroundings));
  Lengths<double> before = judge(path.from);
  Knot last = follower.setPoints();
  for (int tick = 1; tick <= cutting.ticks; ++tick) {
    ASSERT_EQ(Outcome::kMoving, follower.tick(own));
    const Knot now = follower.setPoints();
    const Lengths<double> exact = judge(placeOn(path, double(tick) / cutting.ticks));
    const double error = fmax(fabs(toMm<double>(now.left) - exact.left),
                              fabs(toMm<double>(now.right) - exact.right));
    const double jitter =
        fmax(fabs(toMm<double>(now.left - last.left) - (exact.left - before.left)),
             fabs(toMm<double>(now.right - last.right) - (exact.right - before.right)));
    worst.error = fmax(worst.error, error);
    worst.over = fmax(worst.over, error - may);
    worst.jitter = fmax(worst.jitter, jitter);
    ++worst.set_points;
    before = exact;
    last = now;
  }
  EXPECT_EQ(Outcome::kArrived, follower.tick(own));
  EXPECT_EQ(knotAt(own, walked.to).knot.left, follower.setPoints().left);
  EXPECT_EQ(knotAt(own, walked.to).knot.right, follower.setPoints().right);
  worst.segments += (cutting.ticks + cutting.per_segment - 1) / cutting.per_segment;
}

/// The worst of lines and arcs over the sheet.
template <class Real>
Worst worstOver(const Tried& tried, int paths_count, unsigned seed, double step) {
  const Exactly<double> judge = exactly<double>(tried);
  const Exactly<Real> own = exactly<Real>(tried);
  Paths paths(seed);
  Worst worst;
  for (int i = 0; i < paths_count; ++i)
    follow(tried, judge, own, i % 2 ? paths.line() : paths.arc(), step, worst);
  testing::Test::RecordProperty("error_mm", std::to_string(worst.error));
  testing::Test::RecordProperty("jitter_mm", std::to_string(worst.jitter));
  testing::Test::RecordProperty("ticks_per_segment",
                                std::to_string(double(worst.set_points) / double(worst.segments)));
  return worst;
}

}  // namespace

TEST_P(Follower, EverySetPointIsWithinTheBoundOfTheExactInverse) {
  const Worst worst = worstOver<double>(GetParam(), 1000, 20, kStep);
  EXPECT_LT(worst.over, kRounding);
  EXPECT_LT(worst.error, 0.0011);
  EXPECT_GT(worst.error, 0.0005);  // or the bound would waste knots
}

TEST_P(Follower, EverySetPointIsWithinThreeMicrometresInFloat) {
  const Worst worst = worstOver<float>(GetParam(), 1000, 21, kStep);
  EXPECT_LT(worst.error, 0.003);
  EXPECT_LT(worst.jitter, 0.0015);
}

TEST_P(Follower, FastAndSlowFeedsKeepTheBound) {
  for (double step : {0.011, 0.7, 5.0, 60.0}) {
    const Worst worst = worstOver<double>(GetParam(), 60, 22, step);
    EXPECT_LT(worst.over, kRounding) << step;
    EXPECT_LT(worst.error, 0.0011) << step;
  }
}

TEST(PathFollower, AMillionShortMovesEndWhereTheExactInverseSays) {
  const Exactly<float> own = exactly<float>(triedMachines()[0]);
  const Surroundings<float> surroundings = {500, {0.05f, 0.0005f, 1e-5f}};
  Paths paths(23);
  Point<float> at = {0, 0};
  PathFollower<float> follower(knotAt(own, at).knot);
  for (int i = 0; i < 1000000; ++i) {
    // A walk that is drawn back to the middle.
    const Point<float> to = {at.x * 0.999f + float(paths.between(-1, 1)),
                             at.y * 0.999f + float(paths.between(-1, 1))};
    ASSERT_EQ(Outcome::kMoving, follower.follow(line(at, to), 0.15f, surroundings));
    while (follower.tick(own) == Outcome::kMoving) {
    }
    at = to;
  }
  EXPECT_EQ(knotAt(own, at).knot.left, follower.setPoints().left);
  EXPECT_EQ(knotAt(own, at).knot.right, follower.setPoints().right);
}

TEST(PathFollower, StandsUntilItIsGivenAPath) {
  PathFollower<float> follower(Knot{5, 7});
  EXPECT_EQ(Outcome::kArrived, follower.tick(exactly<float>(triedMachines()[0])));
  EXPECT_EQ(5, follower.setPoints().left);
  EXPECT_EQ(7, follower.setPoints().right);
}

TEST(PathFollower, StandsWhereItIsIfThePathIsRefused) {
  PathFollower<float> follower(Knot{5, 7});
  const Path<float> none = line(Point<float>{1, 1}, Point<float>{1, 1});
  EXPECT_EQ(Outcome::kNoPath, follower.follow(none, 0.15f, {500, {0, 0, 0}}));
  EXPECT_EQ(Outcome::kNoPath, follower.tick(exactly<float>(triedMachines()[0])));
  EXPECT_EQ(5, follower.setPoints().left);
  EXPECT_EQ(7, follower.setPoints().right);
}

TEST(PathFollower, StopsAtTheLastGoodKnotBeforeAPlaceOutOfReach) {
  // Up and out between the motors: the sled can no longer hang before the path is at its end.
  const Exactly<double> own = exactly<double>(triedMachines()[0]);
  const Path<double> path = line(Point<double>{0, 500}, Point<double>{0, 1100});
  const Surroundings<double> surroundings = {1400, {0.05, 0.0005, 1e-5}};
  const Cutting<double> cutting = beginCutting(path, kStep, surroundings);
  PathFollower<double> follower(knotAt(own, path.from).knot);
  ASSERT_EQ(Outcome::kMoving, follower.follow(path, kStep, surroundings));
  int ticks = 0;
  while (follower.tick(own) == Outcome::kMoving) ++ticks;
  EXPECT_EQ(Outcome::kOutOfReach, follower.tick(own));
  EXPECT_LT(ticks, cutting.ticks);
  EXPECT_GT(ticks, 0);
  EXPECT_EQ(0, ticks % cutting.per_segment);
  const Reached last = knotAt(own, placeOn(path, double(ticks) / cutting.ticks));
  ASSERT_TRUE(last.reachable);
  EXPECT_EQ(last.knot.left, follower.setPoints().left);
  EXPECT_EQ(last.knot.right, follower.setPoints().right);
  const double next = double(ticks + cutting.per_segment) / cutting.ticks;
  EXPECT_FALSE(knotAt(own, placeOn(path, next)).reachable);
}

TEST(PathFollower, StopsWhereOnlyTheMiddleOrOnlyTheEndOfASegmentIsOutOfReach) {
  for (double hole : {5.0, 10.0}) {
    const auto holed = [hole](Point<double> at) {
      return Lengths<double>{100 + at.x, 100 - at.x, fabs(at.x - hole) > 1};
    };
    PathFollower<double> follower(Knot{toCounts(100.0), toCounts(100.0)});
    const Path<double> path = line(Point<double>{0, 0}, Point<double>{10, 0});
    ASSERT_EQ(Outcome::kMoving, follower.follow(path, 1.0, {1000, {0, 0, 0}}));
    EXPECT_EQ(Outcome::kOutOfReach, follower.tick(holed)) << hole;
    EXPECT_EQ(toCounts(100.0), follower.setPoints().left);
    EXPECT_EQ(toCounts(100.0), follower.setPoints().right);
  }
}

TEST(PathFollower, OnceStoppedStaysStopped) {
  bool reachable = false;
  const auto moody = [&](Point<double> at) {
    return Lengths<double>{100 + at.x, 100 - at.x, reachable};
  };
  PathFollower<double> follower(Knot{toCounts(100.0), toCounts(100.0)});
  const Path<double> path = line(Point<double>{0, 0}, Point<double>{10, 0});
  ASSERT_EQ(Outcome::kMoving, follower.follow(path, 1.0, {1000, {0, 0, 0}}));
  EXPECT_EQ(Outcome::kOutOfReach, follower.tick(moody));
  reachable = true;
  EXPECT_EQ(Outcome::kOutOfReach, follower.tick(moody));
  EXPECT_EQ(Outcome::kMoving, follower.follow(path, 1.0, {1000, {0, 0, 0}}));
  EXPECT_EQ(Outcome::kMoving, follower.tick(moody));
}

TEST(PathFollower, ANewPathEndsTheOldOneAtOnce) {
  const auto easy = [](Point<double> at) { return Lengths<double>{100 + at.x, 100 - at.x, true}; };
  PathFollower<double> follower(Knot{toCounts(100.0), toCounts(100.0)});
  const Path<double> path = line(Point<double>{0, 0}, Point<double>{10, 0});
  ASSERT_EQ(Outcome::kMoving, follower.follow(path, 1.0, {1000, {0, 0, 0}}));
  for (int i = 0; i < 3; ++i) EXPECT_EQ(Outcome::kMoving, follower.tick(easy));
  EXPECT_EQ(toCounts(103.0), follower.setPoints().left);
  EXPECT_EQ(Outcome::kNoFeed, follower.follow(path, 0.0, {1000, {0, 0, 0}}));
  EXPECT_EQ(Outcome::kNoFeed, follower.tick(easy));
  EXPECT_EQ(toCounts(103.0), follower.setPoints().left);
}

TEST(PathFollower, RefusesALengthThatJumps) {
  const auto jump = [](Point<double> at) {
    return Lengths<double>{at.x > 5 ? 4000.0 : 1000.0, 1000, true};
  };
  PathFollower<double> follower(Knot{toCounts(1000.0), toCounts(1000.0)});
  const Path<double> path = line(Point<double>{0, 0}, Point<double>{10, 0});
  ASSERT_EQ(Outcome::kMoving, follower.follow(path, 1.0, {1000, {0, 0, 0}}));
  EXPECT_EQ(Outcome::kOutOfReach, follower.tick(jump));
}
