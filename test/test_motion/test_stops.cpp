// A move that is stopped, held, starved or refused: where it comes to rest and how it goes on.
#include <gtest/gtest.h>

#include <algorithm>

#include "plain.h"

using namespace motion;

namespace {

/// Largest change of speed along x between two ticks [mm/s^2].
double hardestAlongX(const Plain& plain) {
  double most = 0, last = 0, before = 0;
  for (const Asked& now : plain.asked) {
    most = std::max(most, std::fabs(now.x - 2 * last + before) / plain.seconds / plain.seconds);
    before = last;
    last = now.x;
  }
  return most;
}

/// A motion along x at full feed.
Plain cruisingToCorner() {
  Plain plain;
  plain.lineTo(500, 0);
  plain.lineTo(500, 100);
  for (int i = 0; i < 200; ++i) plain.tick();
  return plain;
}

}  // namespace

/// Ticks until the axes stand still, for a minute at most.
void standStill(Plain& plain) {
  for (int i = 0; i < 6000 && (i == 0 || !plain.playback.isAtRest()); ++i) plain.tick();
}

TEST(Hold, StopsWithinTheBrakingDistanceAndATick) {
  for (const double seconds : {0.01, 0.005})
    for (const double feed : {1.0, 4.0, 15.0, 19.0}) {
      Plain plain(kGentle, seconds);
      plain.lineTo(300, 400, 0, float(feed));
      plain.lineTo(0, 0);
      for (int i = 0; i < 1500; ++i) plain.tick();
      const Asked before = plain.asked.back();
      plain.playback.hold();
      standStill(plain);
      const Asked& after = plain.asked.back();
      EXPECT_LE(distance(after, before), feed * feed / 200 + feed * seconds);
      EXPECT_GE(distance(after, before), feed * feed / 200 - feed * seconds);
      EXPECT_NEAR(after.x * 4 - after.y * 3, 0, 0.002);
      EXPECT_LE(hardestAlongX(plain), 105);
    }
}

TEST(Hold, RestsOnThePathAndResumesToTheSameEnd) {
  for (int at = 1; at < 400; at += 7) {
    Plain plain;
    plain.lineTo(20, 0);
    plain.lineTo(20, 20, -1);
    for (int i = 0; i < at; ++i) plain.tick();
    plain.playback.hold();
    standStill(plain);
    const SetPoint held = plain.now;
    EXPECT_LT(std::min(std::fabs(plain.asked.back().y), std::fabs(plain.asked.back().x - 20)),
              0.06);
    for (int i = 0; i < 20; ++i) plain.tick();
    EXPECT_EQ(held.left, plain.now.left);
    EXPECT_EQ(held.right, plain.now.right);
    plain.playback.resume();
    plain.run();
    EXPECT_EQ(toCounts(20.0f), plain.now.left);
    EXPECT_EQ(toCounts(20.0f), plain.now.right);
    EXPECT_EQ(toCounts(-1.0f), plain.now.z);
    // The corner is passed within a tick, at up to 3.5 mm/s.
    EXPECT_LE(hardestAlongX(plain), 410) << at;
    EXPECT_TRUE(plain.playback.isDone());
  }
}

TEST(Hold, ResumedWhileBrakingGoesOnAtThatSpeed) {
  Plain plain = cruisingToCorner();
  plain.playback.hold();
  for (int i = 0; i < 8; ++i) plain.tick();
  plain.playback.resume();
  for (int i = 0; i < 100; ++i) plain.tick();
  const std::vector<double> speeds = plain.speeds();
  EXPECT_GT(*std::min_element(speeds.begin() + 100, speeds.end()), 5);
  EXPECT_LE(hardestAlongX(plain), 105);
}

TEST(Boost, OfShortMovesKeepsAccelerationAndEnd) {
  for (const float times : {1.3f, 2.0f}) {
    Plain plain;
    for (int i = 1; i <= 400; ++i) {
      plain.lineTo(float(i) * 0.4f, float(i % 50 == 0), 0, 6);
      if (i % 40 == 0) plain.mover.boost(i % 80 == 0 ? times : 1, 20);
    }
    plain.run();
    EXPECT_EQ(toCounts(160.0f), plain.now.left);
    EXPECT_LE(hardestAlongX(plain), 450);
    const std::vector<double> speeds = plain.speeds();
    EXPECT_NEAR(*std::max_element(speeds.begin(), speeds.end()), 6 * times, 0.1);
  }
}

TEST(LateMainProgram, StartsAgainFromRest) {
  Plain plain = cruisingToCorner();
  int taken = 0;
  for (int i = 0; i < 30; ++i) taken += plain.tickAlone();
  EXPECT_EQ(int(SetPoints::kMost), taken + 1);
  const Asked waited = plain.asked.back();
  plain.tick();
  EXPECT_NEAR(plain.asked.back().x - waited.x, 100 * kTick * kTick, 1e-3);
  plain.run();
  EXPECT_EQ(toCounts(500.0f), plain.now.left);
  EXPECT_EQ(toCounts(100.0f), plain.now.right);
}

TEST(OutOfReach, SetPointsEndBeforeTheRefusedPlace) {
  Plain plain;
  plain.inverse = [](Point<float> at) -> Lengths<float> { return {at.x, at.y, at.x < 100}; };
  plain.lineTo(200, 0);
  for (int i = 0; i < 2000 && plain.filled == Filled::kYes; ++i) plain.tick();
  EXPECT_EQ(Filled::kOutOfReach, plain.filled);
  while (plain.tickAlone()) {
  }
  EXPECT_LT(plain.asked.back().x, 100);
  plain.mover.forget();
  EXPECT_TRUE(plain.mover.isIdle());
  plain.at = {float(plain.asked.back().x), 0};
  plain.lineTo(0, 0);
  plain.run();
  EXPECT_EQ(0, plain.now.left);
}

TEST(Refused, GivesItsReasonAndChangesNothing) {
  Plain plain;
  plain.add(arc(Point<float>{0, 0}, Point<float>{1, 0}, Point<float>{9, 9}, Turn::kClockwise), 0,
            15);
  EXPECT_EQ(Added::kNoPath, plain.added);
  plain.lineTo(0, 0);
  EXPECT_EQ(Added::kNothing, plain.added);
  plain.add(line(Point<float>{0, 0}, Point<float>{10, 0}), 0, 0);
  EXPECT_EQ(Added::kNoFeed, plain.added);
  plain.add(line(Point<float>{0, 0}, Point<float>{10, 0}), 0, NAN);
  EXPECT_EQ(Added::kNoFeed, plain.added);
  plain.add(line(Point<float>{0, 0}, Point<float>{10, 0}), NAN, 15);
  EXPECT_EQ(Added::kNoPath, plain.added);
  EXPECT_TRUE(plain.mover.isIdle());
  for (int i = 0; i < MoveQueue::kMost; ++i)
    EXPECT_EQ(Added::kYes, plain.mover.add(line(Point<float>{0, 0}, Point<float>{10, 0}), 0, 15));
  EXPECT_EQ(Added::kFull, plain.mover.add(line(Point<float>{0, 0}, Point<float>{10, 0}), 0, 15));
}
