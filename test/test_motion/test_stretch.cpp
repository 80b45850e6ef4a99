// Stretches of many ticks: they agree with single ticks, and they are few.
#include <gtest/gtest.h>

#include <cmath>
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
