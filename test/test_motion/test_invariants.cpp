// What holds after every step of random moves, and stretches of many ticks: they agree with single
// ticks, and they are few.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "plain.h"

using namespace motion;

namespace {

struct Profile {
  std::vector<double> places;  ///< [mm] after each tick
  int stretches = 0;
  float end_speed = 0;
};

/// Walks a move to its end; `most` ticks in a stretch.
Profile walked(float length, float begin, float top, float exit, float a, uint8_t most) {
  Profile profile;
  Walk walk = {0, begin};
  while (walk.done < length && profile.places.size() < 3000) {
    const Bounds bounds = {length - walk.done, top, a, exit * exit, most, most};
    const Stretch stretch = nextStretch(walk.speed, bounds);
    for (uint8_t tick = 1; tick <= stretch.ticks; ++tick)
      profile.places.push_back(double(after(walk, stretch.change, tick).done));
    walk = after(walk, stretch.change, stretch.ticks);
    ++profile.stretches;
    EXPECT_LE(std::fabs(stretch.change), 1.0001f * a) << length << " from " << begin;
    // A single tick may lead beyond the end; more never do.
    EXPECT_TRUE(stretch.ticks == 1 || walk.done <= length * 1.000001f)
        << stretch.ticks << " ticks to " << walk.done << " of " << length;
  }
  profile.end_speed = walk.speed;
  return profile;
}

struct Case {
  float length, begin, top, exit, a;
};

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const float length : {0.04f, 0.7f, 3.0f, 25.0f, 60.0f})
    for (const float begin : {0.0f, 0.05f, 0.14f})
      for (const float exit : {0.0f, 0.04f, 0.15f})
        for (const float a : {0.001f, 0.01f}) {
          // Only what the queue plans: from the begin the exit can be reached in time.
          if (begin * begin > exit * exit + 2 * a * length) continue;
          all.push_back({length, begin, 0.15f, exit, a});
        }
  return all;
}

}  // namespace

TEST(Stretch, AgreesWithSingleTicks) {
  for (const Case& each : cases()) {
    const Profile fine = walked(each.length, each.begin, each.top, each.exit, each.a, 1);
    const Profile coarse = walked(each.length, each.begin, each.top, each.exit, each.a, 181);
    EXPECT_NEAR(double(fine.places.size()), double(coarse.places.size()), 2.01)
        << each.length << " " << each.begin << " " << each.exit << " " << each.a;
    const size_t common = std::min(fine.places.size(), coarse.places.size());
    double farthest = 0;
    for (size_t i = 0; i < common; ++i)
      farthest = std::max(farthest, std::fabs(fine.places[i] - coarse.places[i]));
    // At most by a step of the speed, for a tick or two.
    EXPECT_LT(farthest, 2.5 * double(each.a) + 0.02 * double(each.top))
        << each.length << " " << each.begin << " " << each.exit << " " << each.a;
  }
}

TEST(Stretch, EndsNoFasterThanItMay) {
  for (const Case& each : cases())
    for (const uint8_t most : {1, 7, 181}) {
      const Profile profile = walked(each.length, each.begin, each.top, each.exit, each.a, most);
      // The last tick may change the speed by the acceleration, or be the short rest of the way.
      const double short_way = std::min(double(each.a), double(each.length));
      // The tick that passes the end is half an acceleration faster than the speed at the end.
      const double exit = double(each.exit) + 0.5 * double(each.a);
      EXPECT_LE(double(profile.end_speed), std::max(exit, short_way) + 1e-4)
          << each.length << " " << each.begin << " " << each.exit << " " << each.a;
    }
}

TEST(Stretch, TakesTheTimeOfATrapezoid) {
  for (const Case& each : cases()) {
    if (each.begin != 0 || each.exit != 0) continue;
    const double ramps = double(each.top * each.top / each.a);
    const double length = double(each.length), a = double(each.a), top = double(each.top);
    const double ticks =
        length < ramps ? 2 * std::sqrt(length / a) : 2 * top / a + (length - ramps) / top;
    for (const uint8_t most : {1, 181})
      EXPECT_NEAR(double(walked(each.length, 0, each.top, 0, each.a, most).places.size()), ticks,
                  2.6)
          << length << " " << a << " " << int(most);
  }
}

TEST(Stretch, UsesFewStretchesForAMove) {
  // 60 mm at 0.15 a tick: 385 ticks, of which 150 gain speed and 150 lose it.
  EXPECT_LE(walked(60, 0, 0.15f, 0, 0.001f, 181).stretches, 9);
  EXPECT_LE(walked(60, 0, 0.15f, 0, 0.01f, 181).stretches, 9);
  EXPECT_LE(walked(25, 0.14f, 0.15f, 0.04f, 0.001f, 181).stretches, 9);
  EXPECT_LE(walked(60, 0.08f, 0.15f, 0, 0.001f, 181).stretches, 9);
  EXPECT_LE(walked(4, 0.05f, 1, 0, 0.001f, 181).stretches, 9);
}

TEST(Stretch, IsNoLongerThanItsLimitOfTicks) {
  for (const uint8_t most : {1, 2, 40}) {
    const Stretch gains = nextStretch(0, {1000, 100, 0.01f, 0, 99, most});
    EXPECT_EQ(most, gains.ticks);
    EXPECT_FLOAT_EQ(0.01f, gains.change);
    const Stretch cruises = nextStretch(0.1f, {1000, 0.1f, 0.01f, 0, most, 99});
    EXPECT_EQ(most, cruises.ticks);
    EXPECT_EQ(0, cruises.change);
  }
}

TEST(Stretch, SlowsToALoweredTopSpeed) {
  const float a = 0.01f, top = 0.03f;
  float speed = 0.15f;
  int ticks = 0;
  while (speed > top + a) {
    const Stretch stretch = nextStretch(speed, {10, top, a, 0, 181, 181});
    EXPECT_FLOAT_EQ(-a, stretch.change);
    ticks += stretch.ticks;
    speed += stretch.change * float(stretch.ticks);
  }
  EXPECT_EQ(12, ticks) << "by a hundredth each";
  EXPECT_NEAR(double(speed), double(top), 1e-5);
  // Where the end is nearer than that, each stretch is a single tick.
  EXPECT_EQ(1, nextStretch(0.15f, {0.5f, top, a, 0, 181, 181}).ticks);
}

TEST(After, IsTheSumOfItsTicks) {
  const Walk begin = {3, 0.2f};
  double done = 3, speed = 0.2;
  for (uint8_t tick = 1; tick < 30; ++tick) {
    speed += -0.005;
    done += speed;
    EXPECT_NEAR(double(after(begin, -0.005f, tick).done), done, 1e-5) << int(tick);
    EXPECT_NEAR(double(after(begin, -0.005f, tick).speed), speed, 1e-6) << int(tick);
  }
}

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
