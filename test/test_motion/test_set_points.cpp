// Every set-point, while moves speed up and slow down, against the exact inverse in double.
#include <gtest/gtest.h>

#include "machines.h"

using namespace motion;

namespace {

class SetPointsOf : public testing::TestWithParam<Tried> {};
INSTANTIATE_TEST_SUITE_P(Machines, SetPointsOf, testing::ValuesIn(triedMachines()), NameOfTried());

struct Worst {
  double error = 0;   // [mm] of a chain, at any tick
  double jerked = 0;  // [mm] difference of a step from that of the exact chains
  long set_points = 0, asked = 0;
};

/// Walks a path from rest to rest, with a random z.
void walk(const Tried& tried, const Exactly<double>& judge, const Exactly<float>& inverse,
          const Path<double>& path, const Limits& limits, double feed, Worst& worst) {
  const auto counted = [&](Point<float> place) {
    ++worst.asked;
    return inverse(place);
  };
  const Path<float> walked = as<float>(path);
  const Knot start = knotAt(inverse, walked.from).knot;
  Mover mover;
  SetPoints set_points;
  mover.prepare(limits, 0.01f);
  mover.setSprockets(sprocketsOf(tried));
  mover.standAt({start.left, start.right, 0});
  ASSERT_EQ(Added::kYes, mover.add(walked, 0, float(feed)));
  Lengths<double> before = judge(path.from);
  SetPoint last = mover.last();
  while (!mover.isIdle()) {
    // Set-points are taken one by one, because a full ring would hide which tick is which.
    SetPoints single;
    for (int i = 1; i < SetPoints::kMost; ++i) {
      single.vacant() = {last, 1, 1, 0};
      single.push();
    }
    ASSERT_EQ(Filled::kYes, mover.fill(single, counted));
    const SetPoint now = mover.last();
    const double share = mover.isIdle() ? 1 : double(mover.walk().done) / double(walked.length);
    const Lengths<double> exact = judge(placeOn(path, share));
    const double left = toMm<double>(now.left) - exact.left;
    const double right = toMm<double>(now.right) - exact.right;
    worst.error = fmax(worst.error, fmax(fabs(left), fabs(right)));
    const double left_before = toMm<double>(last.left) - before.left;
    const double right_before = toMm<double>(last.right) - before.right;
    worst.jerked = fmax(worst.jerked, fmax(fabs(left - left_before), fabs(right - right_before)));
    ++worst.set_points;
    before = exact;
    last = now;
  }
  EXPECT_EQ(knotAt(inverse, walked.to).knot.left, last.left);
  EXPECT_EQ(knotAt(inverse, walked.to).knot.right, last.right);
}

Worst worstOver(const Tried& tried, int count, unsigned seed, const Limits& limits, double feed) {
  const Exactly<double> judge = exactly<double>(tried);
  const Exactly<float> inverse = exactly<float>(tried);
  Paths paths(seed);
  Worst worst;
  for (int i = 0; i < count; ++i)
    walk(tried, judge, inverse, i % 2 ? paths.line() : paths.arc(), limits, feed, worst);
  testing::Test::RecordProperty("error_mm", std::to_string(worst.error));
  testing::Test::RecordProperty("jerked_mm", std::to_string(worst.jerked));
  const double per_ask = double(worst.set_points) / double(worst.asked);
  testing::Test::RecordProperty("ticks_per_inverse", std::to_string(per_ask));
  return worst;
}

}  // namespace

TEST_P(SetPointsOf, AreWithinThreeMicrometresOfTheExactChains) {
  const Worst worst = worstOver(GetParam(), 400, 31, {100, 10, 20, 0.66f, 0.05f}, 15);
  EXPECT_LT(worst.error, 0.003);
  EXPECT_LT(worst.jerked, 0.002);
  EXPECT_GT(worst.set_points, 2 * worst.asked);
}

TEST_P(SetPointsOf, KeepTheBoundAtAnyFeedAndAcceleration) {
  for (const double feed : {2.0, 80.0, 600.0})
    for (const float acceleration : {20.0f, 2000.0f}) {
      const Worst worst =
          worstOver(GetParam(), 30, 32, {acceleration, 10, 1000, 0.66f, 0.05f}, feed);
      EXPECT_LT(worst.error, 0.003) << feed << " " << acceleration;
    }
}

TEST(SetPoints, GiveTheStepAheadOrTheLastKnownOne) {
  SetPoints ring;
  const SetPoint *from = nullptr, *to = nullptr;
  int32_t pushed = 0, taken = 0;
  Leg leg = {{0, 0, 0}, 1, 1, 0};
  EXPECT_FALSE(ring.stepAhead(3, from, to));
  // Twice round the ring and with every number that may wait: set-points are the squares.
  for (int waiting = 0; waiting < SetPoints::kMost; ++waiting) {
    for (int i = 0; i < 2 * SetPoints::kMost; ++i) {
      while (pushed - taken < waiting + 1) {
        ASSERT_TRUE(ring.hasRoom());
        ++pushed;
        ring.vacant() = {{pushed * pushed, -pushed, 0}, 1, 1, 0};
        ring.push();
      }
      ASSERT_TRUE(ring.take(leg));
      ++taken;
      ASSERT_EQ(taken * taken, leg.to.left);
      ASSERT_EQ(waiting > 0, ring.stepAhead(3, from, to));
      if (waiting == 0) continue;
      const int32_t last = taken + (waiting < 3 ? waiting : 3);
      ASSERT_EQ(last * last, to->left);
      ASSERT_EQ((last - 1) * (last - 1), from->left);
    }
  }
}
