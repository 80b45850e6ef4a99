// The invariants of mover_detail.h and stretch.h, checked after every step of random moves.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "plain.h"

using namespace motion;

namespace {

const double kOnSheet = 0.01;  // [mm/tick^2] acceleration of moves without z

/// Random moves in a row, and a mover that is checked after each set-point.
class Asking {
 public:
  explicit Asking(unsigned seed) : random_(seed) {
    mover_.prepare(kGentle, float(kTick));
    mover_.setSprockets({{-1e6f, 1e6f}, {1e6f, 1e6f}, {0, 0, 0}});
    mover_.standAt({0, 0, 0});
  }

  /// Takes set-points, and queues moves meanwhile, until all are done.
  void go(int moves) {
    while (moves > 0 || !mover_.isIdle() || !points_.isEmpty()) {
      while (moves > 0 && mover_.hasRoom() && any(0, 1) < 0.7f) {
        add();
        --moves;
      }
      if (any(0, 1) < 0.002f) {
        mover_.boost(any(0.2f, 2), 40);
        is_boosted_ = true;
      }
      ASSERT_EQ(Filled::kYes, mover_.fill(points_, plainInverse));
      expectPlanned();
      Leg leg;
      if (points_.take(leg)) expectNear(leg);
    }
    expectArrived();
  }

 private:
  float any(float least, float most) {
    return std::uniform_real_distribution<float>(least, most)(random_);
  }

  void add() {
    const float size = std::pow(10.0f, any(-1.5f, 1.7f));
    const Point<float> to = {at_.x + any(-1, 1) * size, at_.y + any(-1, 1) * size};
    const int kind = int(any(0, 10));
    if (kind < 3) z_ += any(-1, 1) * size * 0.1f;
    Path<float> path = line(at_, kind == 0 ? at_ : to);
    if (kind > 6) {
      const Point<float> centre = {at_.x + any(-1, 1) * size, at_.y + any(0.1f, 1) * size};
      path = arc(at_, at_, centre, kind > 8 ? Turn::kClockwise : Turn::kCounterclockwise);
    }
    const Added added = mover_.add(path, z_, any(0.5f, 20));
    if (added == Added::kYes && path.drawn == Drawn::kYes) at_ = path.to;
    ASSERT_TRUE(added == Added::kYes || added == Added::kNothing);
  }

  /// What holds of the plan after each fill.
  void expectPlanned() {
    const Walk walk = mover_.walk();
    EXPECT_GE(walk.done, 0);
    EXPECT_GE(walk.speed, 0);
    if (mover_.isIdle()) {
      is_boosted_ = false;
      EXPECT_EQ(0, walk.done);
      EXPECT_EQ(0, walk.speed);
      return;
    }
    const Move& move = mover_.queue().first();
    EXPECT_LE(walk.done, move.length * 1.000001f);
    // The next tick can brake by the acceleration, and then still keep the speed at the end.
    const double a = double(move.acceleration), left = double(move.length - walk.done);
    const double exit = double(mover_.queue().exitSquared());
    const double next = double(walk.speed) - a;
    const double may = std::sqrt(exit + 2 * a * left) - 0.5 * a;
    // A feed that was lowered may ask for more.
    if (is_boosted_) return;
    EXPECT_LE(next,
              std::max({may, std::sqrt(exit), std::min(a, left)}) + 0.53 * std::max(a, kOnSheet))
        << walk.speed << " with " << left << " left";
    const MoveQueue& queue = mover_.queue();
    if (queue.count() > 1) {
      EXPECT_LE(queue.exitSquared(), queue.second().top * queue.second().top);
    }
  }

  /// What holds of each leg.
  void expectNear(const Leg& leg) {
    const double left = leg.to.left - at_counts_.left, right = leg.to.right - at_counts_.right;
    const double z = leg.to.z - at_counts_.z;
    // Chains are places here. Rounding of a change, 181 times, is 90 counts.
    EXPECT_LE(std::sqrt(left * left + right * right + z * z), leg.way + 100.0);
    EXPECT_GE(leg.way, 1u);
    EXPECT_LT(leg.way, 1u << 17);
    EXPECT_GE(leg.gain, 1);
    at_counts_ = leg.to;
  }

  void expectArrived() {
    EXPECT_EQ(toCounts(at_.x), at_counts_.left);
    EXPECT_EQ(toCounts(at_.y), at_counts_.right);
    EXPECT_EQ(toCounts(z_), at_counts_.z);
  }

  std::mt19937 random_;
  Mover mover_;
  SetPoints points_;
  Point<float> at_ = {0, 0};
  float z_ = 0;
  SetPoint at_counts_ = {0, 0, 0};
  bool is_boosted_ = false;
};

}  // namespace

TEST(Stretch, BrakesInTimeFromASlightlyTooHighSpeed) {
  // 42 ticks of braking would lead 0.0006 mm beyond the end, and 41 ticks 0.0002 mm.
  const Bounds bounds = {0.690374553f, 0.0352992341f, 0.000781127019f, 0, 181, 181};
  const Stretch stretch = nextStretch(0.0332463309f, bounds);
  EXPECT_LE(after({0, 0.0332463309f}, stretch.change, stretch.ticks).done, bounds.left);
  EXPECT_EQ(40, stretch.ticks);
}

TEST(Invariants, HoldForTheMoverAfterEachStepOfRandomMoves) {
  for (unsigned seed = 0; seed < 60 && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    Asking(seed).go(60);
  }
}

TEST(Invariants, HoldForAStretchWithRandomBounds) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> any(0, 1);
  for (int i = 0; i < 200000 && !testing::Test::HasFailure(); ++i) {
    const float a = std::pow(10.0f, -4 + 3 * any(random)), top = a * (0.1f + 60 * any(random));
    const float exit = any(random) < 0.4f ? 0 : top * any(random);
    const uint8_t even = uint8_t(1 + random() % kMostTicks),
                  uneven = uint8_t(1 + random() % kMostTicks);
    Walk walk = {0, 0};
    const float length = a * std::pow(10.0f, -1 + 5 * any(random));
    // The fastest begin from which the exit can still be reached.
    const float fastest = std::sqrt(exit * exit + 2 * a * length) - 0.5f * a;
    walk.speed = any(random) < 0.3f ? 0 : std::max(0.0f, std::min(top, fastest) * any(random));
    for (int ticks = 0; walk.done < length * 0.999999f && ticks < 20000;) {
      const Bounds bounds = {length - walk.done, top, a, exit * exit, even, uneven};
      const Stretch stretch = nextStretch(walk.speed, bounds);
      const Walk next = after(walk, stretch.change, stretch.ticks);
      EXPECT_GE(stretch.ticks, 1);
      EXPECT_LE(stretch.ticks, std::max(even, uneven));
      // The last two ticks before an end may brake harder, as their way is short.
      const float most = bounds.left > 2.5f * a ? 1.25f * a : 2 * a;
      EXPECT_LE(std::fabs(stretch.change), most);
      if (stretch.ticks > 1) {
        EXPECT_TRUE(stretch.change == 0 ? stretch.ticks <= even : stretch.ticks <= uneven);
        EXPECT_TRUE(stretch.change == 0 || std::fabs(stretch.change) == a);
        EXPECT_LE(next.done, length * 1.000001f);
      }
      EXPECT_GE(next.done, walk.done - 0.02f * a);
      EXPECT_GE(next.speed, -0.02f * a);
      EXPECT_LE(next.speed, std::max(walk.speed, top + 0.02f * a) * 1.00001f);
      if (testing::Test::HasFailure()) {
        ADD_FAILURE() << "a " << a << " top " << top << " exit " << exit << " length " << length
                      << " done " << walk.done << " speed " << walk.speed;
        return;
      }
      walk = next;
      ticks += stretch.ticks;
    }
    EXPECT_LE(walk.speed, std::max(exit + 0.55f * a, std::min(a, length) + 0.02f * a) * 1.0001f)
        << "a " << a << " top " << top << " exit " << exit << " length " << length;
  }
}
