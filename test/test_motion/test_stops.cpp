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

TEST(Hold, StandsWithinTheBrakingDistanceAndATick) {
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

TEST(Hold, LosesSpeedNoFasterThanItMayAtAnyMoment) {
  for (int at = 1; at < 120; ++at) {
    Plain plain;
    plain.lineTo(12, 0);
    for (int i = 0; i < at; ++i) plain.tick();
    plain.playback.hold();
    standStill(plain);
    EXPECT_LE(hardestAlongX(plain), 205) << at;
    EXPECT_LE(plain.asked.back().x, 12.0001);
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

TEST(Hold, InShortMovesRunsThroughSeveralOfThem) {
  Plain plain;
  for (int i = 1; i <= 300; ++i) plain.lineTo(float(i) * 0.1f, 0);
  const double before = plain.asked.back().x;
  plain.playback.hold();
  standStill(plain);
  EXPECT_LE(hardestAlongX(plain), 205);
  EXPECT_LT(plain.asked.back().x, before + 1.3);
  plain.playback.resume();
  plain.run();
  EXPECT_EQ(toCounts(30.0f), plain.now.left);
}

TEST(Hold, ResumedWhileStillBrakingGoesOnAtThatSpeed) {
  Plain plain = cruisingToCorner();
  plain.playback.hold();
  for (int i = 0; i < 8; ++i) plain.tick();
  plain.playback.resume();
  for (int i = 0; i < 100; ++i) plain.tick();
  const std::vector<double> speeds = plain.speeds();
  EXPECT_GT(*std::min_element(speeds.begin() + 100, speeds.end()), 5);
  EXPECT_LE(hardestAlongX(plain), 105);
}

TEST(Hold, WithNothingToDoKeepsWhatComes) {
  Plain plain;
  plain.playback.hold();
  plain.lineTo(1, 0);
  for (int i = 0; i < 50; ++i) plain.tick();
  EXPECT_EQ(0, plain.now.left);
  plain.playback.resume();
  plain.run();
  EXPECT_EQ(toCounts(1.0f), plain.now.left);
}

TEST(Hold, ForgottenGoesOnFromWhereItStands) {
  Plain plain = cruisingToCorner();
  plain.playback.hold();
  standStill(plain);
  plain.set_points.clear();
  plain.playback.reset();
  plain.playback.resume();
  plain.mover.standAt(plain.now);
  plain.at = {float(plain.asked.back().x), float(plain.asked.back().y)};
  plain.lineTo(0, 0);
  plain.run();
  EXPECT_EQ(0, plain.now.left);
  EXPECT_LE(hardestAlongX(plain), 205);
}

TEST(Share, IsThatOfThePlannedSpeedAllTheWay) {
  for (const int share : {26, 64, 128, 200, 255}) {
    Plain plain;
    plain.playback.goAt(uint16_t(share));
    plain.lineTo(60, 0);
    plain.lineTo(60, 60);
    plain.lineTo(60.1f, 60.3f);
    plain.run();
    EXPECT_EQ(toCounts(60.1f), plain.now.left);
    EXPECT_EQ(toCounts(60.3f), plain.now.right);
    const std::vector<double> speeds = plain.speeds();
    EXPECT_NEAR(*std::max_element(speeds.begin(), speeds.end()), 15.0 * share / 256, 0.03);
    // Here, too, the corner is passed within a tick.
    EXPECT_LE(hardestAlongX(plain), 105 + 350.0 * share / 256);
    EXPECT_TRUE(plain.playback.isDone());
  }
}

TEST(Share, ChangesWithinTheAcceleration) {
  Plain plain = cruisingToCorner();
  for (const int share : {128, 30, 256, 255, 100, 256}) {
    plain.playback.goAt(uint16_t(share));
    for (int i = 0; i < 60; ++i) plain.tick();
    EXPECT_NEAR(plain.speeds().back(), 15.0 * share / 256, 0.03) << share;
  }
  EXPECT_LE(hardestAlongX(plain), 105);
  plain.run();
  EXPECT_EQ(toCounts(500.0f), plain.now.left);
  EXPECT_EQ(toCounts(100.0f), plain.now.right);
}

TEST(Boost, MakesMovesFasterWithinTheirLimits) {
  Plain plain;
  plain.lineTo(200, 0, 0, 8);
  for (int i = 0; i < 200; ++i) plain.tick();
  plain.mover.boost(1.5f, 15);
  for (int i = 0; i < 100; ++i) plain.tick();
  EXPECT_NEAR(plain.speeds().back(), 12, 0.01);
  plain.mover.boost(2, 15);
  for (int i = 0; i < 100; ++i) plain.tick();
  EXPECT_NEAR(plain.speeds().back(), 15, 0.01);
  plain.mover.boost(1, 15);
  for (int i = 0; i < 100; ++i) plain.tick();
  EXPECT_NEAR(plain.speeds().back(), 8, 0.01);
  plain.run();
  EXPECT_EQ(toCounts(200.0f), plain.now.left);
  EXPECT_LE(hardestAlongX(plain), 105);
}

TEST(Boost, InARowOfShortMovesKeepsAccelerationAndEnd) {
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

TEST(LateMainProgram, SetPointsWaitWhereTheyAreAndSetOutFromRest) {
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

TEST(LateMainProgram, IsNotBlamedForAPauseBetweenMoves) {
  Plain plain;
  for (int i = 0; i < 50; ++i) plain.tick();
  plain.lineTo(10, 0);
  plain.run();
  EXPECT_LE(hardestAlongX(plain), 105);
  EXPECT_LT(plain.asked.size(), 50u + 90u);
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

TEST(Refused, IsNamedAndChangesNothing) {
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
