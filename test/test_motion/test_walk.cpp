// Playback along legs of all three axes: where it is, how fast it may change, what it keeps when it
// yields, how it ends.
#include <Motion.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "plain.h"

using namespace motion;

namespace {

/// A walk along legs that the test lays, refilled before each tick as long as there are any.
struct Walker {
  explicit Walker(std::vector<Leg> way) : legs(std::move(way)) {}

  bool tick() {
    while (next < legs.size() && ring.hasRoom()) {
      ring.vacant() = legs[next++];
      ring.push();
    }
    return playback.next(ring, now);
  }
  void ticks(int count) {
    for (int i = 0; i < count; ++i) tick();
  }

  std::vector<Leg> legs;
  size_t next = 0;
  SetPoints ring;
  Playback playback;
  SetPoint now = {0, 0, 0};
};

/// Legs of 600 to the left, 300 back on the right, 90 up; their way is 1000.
std::vector<Leg> evenLegs(int count, uint16_t gain, uint8_t beam = 200) {
  std::vector<Leg> legs;
  for (int i = 1; i <= count; ++i) legs.push_back({{600 * i, -300 * i, 90 * i}, 1000, gain, beam});
  return legs;
}

/// The exact place after a number of counts along even legs.
void expectAt(double way, const SetPoint& now, const char* when) {
  EXPECT_NEAR(now.left, 0.6 * way, 1.2) << when << ", " << way;
  EXPECT_NEAR(now.right, -0.3 * way, 1.2) << when << ", " << way;
  EXPECT_NEAR(now.z, 0.09 * way, 1.2) << when << ", " << way;
}

/// Legs of very different ways, as where speed changes; all axes differ.
std::vector<Leg> unevenLegs() {
  const int32_t steps[] = {1000, 400, 1600, 900, 90, 2000, 1200, 700, 300, 1500, 800, 60};
  std::vector<Leg> legs;
  SetPoint at = {0, 0, 0};
  for (const int32_t step : steps) {
    at = {at.left + step, at.right - step / 2, at.z + step / 4};
    legs.push_back({at, uint32_t(step), 65535, 100});
  }
  return legs;
}

/// Where uneven legs lead at a time [ticks of the planned speed].
double leftAt(const std::vector<Leg>& legs, double time) {
  const size_t leg = std::min(size_t(time), legs.size() - 1);
  const double from = leg == 0 ? 0 : double(legs[leg - 1].to.left);
  return from + (double(legs[leg].to.left) - from) * std::min(1.0, time - double(leg));
}

}  // namespace

TEST(Walk, TakesEachSetPointExactlyAtFullSpeed) {
  Walker walker(evenLegs(20, 30));
  for (int i = 1; i <= 20; ++i) {
    EXPECT_TRUE(walker.tick()) << i;
    EXPECT_EQ(600 * i, walker.now.left);
    EXPECT_EQ(-300 * i, walker.now.right);
    EXPECT_EQ(90 * i, walker.now.z);
    EXPECT_EQ(200, walker.playback.beam()) << i;
  }
  EXPECT_FALSE(walker.tick());
  EXPECT_EQ(600 * 20, walker.now.left) << "it stays";
  EXPECT_TRUE(walker.playback.isAtRest());
  EXPECT_EQ(0, walker.playback.beam());
}

TEST(Walk, BrakesAndStartsByItsAcceleration) {
  for (const uint16_t gain : {30, 250, 999, 1000, 3000}) {
    Walker walker(evenLegs(200, gain));
    walker.ticks(3);
    double way = 3000, speed = 1000;
    walker.playback.hold();
    while (speed > 0) {
      speed = std::max(0.0, speed - gain);
      way += speed;
      EXPECT_EQ(speed > 0, walker.tick()) << gain << ", " << speed;
      expectAt(way, walker.now, "braking");
      EXPECT_NEAR(walker.playback.beam(), 200 * speed / 1000, 0.56) << gain << ", " << speed;
    }
    for (int i = 0; i < 3; ++i) EXPECT_FALSE(walker.tick()) << "held, gain " << gain;
    expectAt(way, walker.now, "at rest");
    EXPECT_TRUE(walker.playback.isAtRest()) << gain;
    walker.playback.resume();
    for (int i = 0; i < 40; ++i) {
      speed = std::min(1000.0, speed + gain);
      way += speed;
      EXPECT_TRUE(walker.tick()) << gain << ", " << speed;
      expectAt(way, walker.now, "setting out");
    }
  }
}

TEST(Walk, ChangesItsShareByTheGain) {
  Walker walker(evenLegs(400, 30));
  walker.ticks(2);
  double speed = 1000;
  for (const uint16_t share : {128, 32, 200, 1, 256}) {
    walker.playback.goAt(share);
    const double asked = std::floor(1000.0 * share / 256);
    for (int i = 0; i < 45; ++i) {
      speed = speed > asked ? std::max(asked, speed - 30) : std::min(asked, speed + 30);
      const SetPoint before = walker.now;
      EXPECT_TRUE(walker.tick());
      EXPECT_NEAR(walker.now.left - before.left, 0.6 * speed, 2) << share << ", " << i;
      EXPECT_NEAR(walker.now.right - before.right, -0.3 * speed, 2) << share << ", " << i;
      EXPECT_NEAR(walker.now.z - before.z, 0.09 * speed, 2) << share << ", " << i;
    }
    EXPECT_EQ(asked, speed) << share;
    EXPECT_NEAR(walker.playback.beam(), 200 * speed / 1000, 0.56) << share;
  }
}

TEST(Walk, ReturnsToFullSpeedInTheMiddleOfALeg) {
  std::vector<Leg> legs;
  for (int i = 1; i <= 200; ++i) legs.push_back({{1024 * i, 0, 0}, 1024, 100, 0});
  Walker walker(legs);
  walker.ticks(2);
  walker.playback.goAt(128);
  // An odd number: at full speed it is half a leg behind its set-points.
  walker.ticks(21);
  walker.playback.goAt(256);
  double speed = 512;
  for (int i = 0; i < 20; ++i) {
    const int32_t before = walker.now.left;
    walker.tick();
    speed = std::min(1024.0, speed + 100);
    EXPECT_NEAR(walker.now.left - before, speed, 1.2) << i;
  }
}

TEST(Walk, AtAShareFollowsThePlanAtThatShareOfTime) {
  for (const uint16_t share : {128, 64, 192}) {
    Walker walker(unevenLegs());
    walker.playback.goAt(share);
    double farthest = 0;
    for (int i = 1; walker.tick(); ++i) {
      ASSERT_LT(i, 200);
      const double expected = leftAt(walker.legs, i * share / 256.0);
      farthest = std::max(farthest, std::fabs(walker.now.left - expected));
      EXPECT_NEAR(walker.now.right, -walker.now.left / 2.0, 4) << i;
      EXPECT_NEAR(walker.now.z, walker.now.left / 4.0, 4) << i;
    }
    // Shares of a leg are 4096ths, and a share of a speed is a whole count.
    EXPECT_LT(farthest, 80) << share;
    EXPECT_EQ(walker.legs.back().to.left, walker.now.left) << "to the count";
    EXPECT_EQ(walker.legs.back().to.right, walker.now.right);
    EXPECT_EQ(walker.legs.back().to.z, walker.now.z);
    EXPECT_TRUE(walker.playback.isAtRest());
    EXPECT_TRUE(walker.playback.isDone());
  }
}

TEST(Walk, HeldAtTheEndOfALegGoesOnIntoTheNext) {
  // By 250 a tick it stands after 750 + 500 + 250 counts, in the middle of a leg; by 1000 at once.
  Walker walker(evenLegs(10, 1000));
  walker.ticks(2);
  walker.playback.hold();
  EXPECT_FALSE(walker.tick());
  EXPECT_EQ(1200, walker.now.left);
  walker.playback.resume();
  EXPECT_TRUE(walker.tick());
  EXPECT_EQ(1800, walker.now.left);
  EXPECT_EQ(-900, walker.now.right);
  EXPECT_EQ(270, walker.now.z);
}

TEST(Walk, ForgottenStartsWithTheNextSetPoint) {
  Walker walker(evenLegs(2, 30));
  walker.playback.goAt(128);
  walker.ticks(3);
  walker.playback.reset();
  EXPECT_TRUE(walker.playback.isAtRest());
  EXPECT_TRUE(walker.playback.isDone());
  EXPECT_EQ(0, walker.playback.beam());
}

TEST(WalkAhead, IsTheStepOfAllAxes) {
  Walker full(evenLegs(30, 30));
  full.ticks(3);
  SetPoint step = full.playback.stepAhead(full.ring, 3);
  EXPECT_EQ(600, step.left);
  EXPECT_EQ(-300, step.right);
  EXPECT_EQ(90, step.z);
  Walker half(evenLegs(30, 30));
  half.playback.goAt(128);
  half.ticks(20);
  step = half.playback.stepAhead(half.ring, 3);
  EXPECT_NEAR(step.left, 300, 1);
  EXPECT_NEAR(step.right, -150, 1);
  EXPECT_NEAR(step.z, 45, 1);
  half.playback.hold();
  half.tick();
  step = half.playback.stepAhead(half.ring, 3);
  EXPECT_NEAR(step.left, 0.6 * (500 - 30 - 90), 1) << "three ticks of braking later";
  EXPECT_NEAR(step.right, -0.3 * (500 - 30 - 90), 1);
  EXPECT_NEAR(step.z, 0.09 * (500 - 30 - 90), 1);
}

TEST(WalkAhead, IsZeroBeforeTheStart) {
  Walker walker(evenLegs(30, 30));
  const SetPoint step = walker.playback.stepAhead(walker.ring, 3);
  EXPECT_EQ(0, step.left);
  EXPECT_EQ(0, step.right);
  EXPECT_EQ(0, step.z);
}

namespace {

const uint8_t kAhead = 4;  // [ticks]

/// A motion along x at 15 mm/s, 0.15 mm a tick, which may change by 0.01 mm each tick.
Plain cruising() {
  Plain plain;
  plain.lineTo(500, 0);
  for (int i = 0; i < 200; ++i) plain.tick();
  return plain;
}

double speedAfter(Plain& plain, int ticks) {
  for (int i = 0; i < ticks; ++i) plain.tick();
  return plain.speeds().back();
}

/// [mm] along x.
double stepAhead(const Plain& plain) {
  return toMm<double>(plain.playback.stepAhead(plain.set_points, kAhead).left);
}

}  // namespace

TEST(Yielding, MultipliesWithTheCommandedShare) {
  Plain plain = cruising();
  plain.playback.yieldTo(128);
  EXPECT_NEAR(7.5, speedAfter(plain, 60), 0.03);
  plain.playback.goAt(128);
  EXPECT_NEAR(3.75, speedAfter(plain, 60), 0.03);
  plain.playback.yieldTo(256);
  EXPECT_NEAR(7.5, speedAfter(plain, 60), 0.03);
  plain.playback.goAt(256);
  EXPECT_NEAR(15, speedAfter(plain, 60), 0.03);
}

TEST(StepAhead, IsZeroWhenHeldBeforeTheStart) {
  Plain plain;
  plain.playback.hold();
  plain.lineTo(10, 0);
  plain.tick();
  EXPECT_FALSE(plain.set_points.isEmpty());
  EXPECT_EQ(0, stepAhead(plain));
  EXPECT_TRUE(plain.playback.isDone()) << "nothing is taken";
}

TEST(Share, StaysAtRestWithoutSetPoints) {
  Plain plain;
  plain.playback.goAt(128);
  EXPECT_FALSE(plain.tickAlone());
  plain.lineTo(3, 0);
  plain.run();
  EXPECT_FALSE(plain.tickAlone());
  EXPECT_TRUE(plain.playback.isAtRest());
  EXPECT_TRUE(plain.playback.isDone());
}

TEST(Share, BringsEveryPathToItsEnd) {
  for (uint16_t share = 1; share <= Playback::kAllOfIt; ++share)
    for (int length = 1; length <= 21; ++length) {
      Plain plain;
      plain.playback.goAt(share);
      const float to = float(length) * float(length) * 0.01f;
      plain.lineTo(0, 0, to, 0.66f);
      plain.lineTo(to, 0, to);
      int most = 4000 + 512 * 900 / share;  // [ticks] a count may be half of a slow share
      do {
        plain.tick();
      } while (--most > 0 && !(plain.set_points.isEmpty() && plain.playback.isDone()));
      ASSERT_NEAR(to, plain.asked.back().x, 1e-3) << share << "/256 of " << to << " mm";
      ASSERT_NEAR(to, plain.asked.back().z, 1e-3) << share << "/256 of " << to << " mm";
    }
}

TEST(Yield, IsFullSpeedUpToHalfTheLimitThenFallsEvenly) {
  Yield yield;
  yield.tune(2);
  EXPECT_EQ(256, yield.shareAt(0));
  EXPECT_EQ(256, yield.shareAt(toCounts(1.0f)));
  EXPECT_NEAR(256 - 115, yield.shareAt(toCounts(1.4f)), 1);
  EXPECT_EQ(26, yield.shareAt(toCounts(1.81f)));
  EXPECT_EQ(26, yield.shareAt(toCounts(2000.0f)));
  uint16_t last = 256;
  for (int32_t off = 0; off < toCounts(3.0f); off += 100) {
    EXPECT_LE(yield.shareAt(off), last);
    EXPECT_LE(last - yield.shareAt(off), 2);
    last = yield.shareAt(off);
  }
}

TEST(Yield, FollowsTheLimitAndIsOffWithoutALimit) {
  Yield yield;
  yield.tune(10);
  EXPECT_EQ(256, yield.shareAt(toCounts(5.0f)));
  EXPECT_EQ(26, yield.shareAt(toCounts(9.1f)));
  yield.tune(2000);
  EXPECT_EQ(256, yield.shareAt(toCounts(3000.0f)));
  yield.tune(0.0001f);
  EXPECT_EQ(26, yield.shareAt(toCounts(1.0f)));
}
