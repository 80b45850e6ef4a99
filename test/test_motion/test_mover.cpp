// Queued moves: speed, acceleration, corners, how long they last, stops, holds and refusals, and
// where they end.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "plain.h"

using namespace motion;

namespace {

double largest(const std::vector<double>& values) {
  return *std::max_element(values.begin(), values.end());
}

/// Largest change of velocity, as a vector, from tick to tick [mm/s^2].
double hardest(const Plain& plain) {
  double most = 0;
  Asked last = {0, 0, 0}, before = {0, 0, 0};
  for (const Asked& now : plain.asked) {
    const double x = now.x - 2 * last.x + before.x, y = now.y - 2 * last.y + before.y;
    const double z = now.z - 2 * last.z + before.z;
    most = std::max(most, std::sqrt(x * x + y * y + z * z) / plain.seconds / plain.seconds);
    before = last;
    last = now;
  }
  return most;
}

/// Time [s] that a trapezoid takes from rest to rest.
double trapezoid(double length, double top, double acceleration) {
  const double ramps = top * top / acceleration;
  if (length < ramps) return 2 * std::sqrt(length / acceleration);
  return 2 * top / acceleration + (length - ramps) / top;
}

const double kRounding = 2.0 / kCountsPerMm;  // [mm]

}  // namespace

TEST(Mover, LineTakesTheTimeOfATrapezoid) {
  for (const float length : {0.03f, 0.4f, 2.0f, 2.25f, 30.0f, 777.0f})
    for (const float feed : {0.5f, 4.0f, 15.0f}) {
      Plain plain;
      plain.lineTo(length, 0, 0, feed);
      plain.run();
      const double took = double(plain.asked.size()) * kTick;
      const double best = trapezoid(double(length), double(feed), 100);
      EXPECT_NEAR(took, best, 0.0451) << length << " " << feed;
      EXPECT_EQ(toCounts(length), plain.now.left);
    }
}

TEST(Mover, FeedIsTrueOnALineOnAnArcAndOverThreeAxes) {
  Plain line, arc, three({200, 200, 20, 20, 0.05f});
  line.lineTo(300, -400, 0, 12.5f);
  arc.arcTo(0, 0, {-100, 0}, 12.5f);
  three.lineTo(30, 40, -120, 12.5f);
  for (Plain* each : {&line, &arc, &three}) {
    each->run();
    const std::vector<double> speeds = each->speeds();
    for (std::size_t i = 30; i + 30 < speeds.size(); ++i) EXPECT_NEAR(12.5, speeds[i], 0.02) << i;
  }
}

TEST(Mover, NeverExceedsItsAcceleration) {
  std::mt19937 random(4);
  for (const double seconds : {0.01, 0.005}) {
    Plain plain(kGentle, seconds);
    for (int i = 0; i < 300; ++i) {
      const float length = std::pow(10.0f, float(random() % 400) / 100 - 1.5f);
      plain.lineTo(plain.at.x > 200 ? plain.at.x - length : plain.at.x + length, 0, 0,
                   float(1 + random() % 15));
    }
    plain.run();
    EXPECT_LE(largest(plain.speeds()), 15.02);
    EXPECT_LE(hardest(plain), 250) << seconds;
  }
}

TEST(Mover, CentripetalAccelerationIsBoundedOnShortMoves) {
  // A circle of 1 mm in steps of 0.1 mm, for which junction deviation alone would allow any speed.
  Plain plain;
  for (int i = 1; i <= 400; ++i)
    plain.lineTo(std::cos(float(i) * 0.1f) - 1, std::sin(float(i) * 0.1f));
  plain.run();
  EXPECT_LE(largest(plain.speeds()), std::sqrt(1.6 * 100 * 1));
  EXPECT_GT(largest(plain.speeds()), std::sqrt(0.8 * 100 * 1));
}

TEST(Mover, SmoothPolylineRunsAtFullFeed) {
  for (const double step : {0.1, 0.15, 0.5, 2.0}) {
    Plain plain;
    const double radius = 40, turns = 200 / radius;
    const int count = int(200 / step);
    for (int i = 1; i <= count; ++i)
      plain.lineTo(float(radius * std::cos(i * turns / count) - radius),
                   float(radius * std::sin(i * turns / count)));
    plain.run();
    EXPECT_NEAR(double(plain.asked.size()) * kTick, trapezoid(200, 15, 100), 0.1) << step;
  }
}

TEST(Mover, NoiseOfRoundedTextDoesNotSlowALine) {
  Plain plain;
  for (int i = 1; i <= 2000; ++i) {
    const double x = i * 0.0953, y = i * 0.0302;
    plain.lineTo(float(std::round(x * 1000) / 1000), float(std::round(y * 1000) / 1000));
  }
  plain.run();
  EXPECT_NEAR(double(plain.asked.size()) * kTick, trapezoid(2000 * 0.09997, 15, 100), 0.1);
}

TEST(Mover, SpeedAtACornerIsThatOfTheArcWithinTheDeviation) {
  for (const double turn : {0.2, 0.7, 1.5708, 2.5}) {
    Plain plain;
    plain.lineTo(50, 0);
    plain.lineTo(50 + float(50 * std::cos(turn)), float(50 * std::sin(turn)));
    plain.run();
    double slowest = 1e9;
    const std::vector<double> speeds = plain.speeds();
    for (std::size_t i = 100; i + 100 < speeds.size(); ++i) slowest = std::min(slowest, speeds[i]);
    const double half = std::cos(turn / 2);
    const double allowed = std::min(15.0, std::sqrt(100 * 0.05 * half / (1 - half)));
    // The tick across the corner is shorter than the way along both sides.
    EXPECT_LE(slowest, allowed * 1.02 + 0.1) << turn;
    EXPECT_GE(slowest, 0.5 * allowed * half) << turn;
    double nearest = 1e9;
    for (const Asked& each : plain.asked) nearest = std::min(nearest, distance(each, {50, 0, 0}));
    EXPECT_LE(nearest, 0.08) << turn;
  }
}

TEST(Mover, NoDeviationMeansAStopAtEachCorner) {
  Plain plain({100, 10, 20, 0.66f, 0});
  plain.lineTo(20, 0);
  plain.lineTo(20, 20);
  plain.run();
  bool was_there = false;
  for (const Asked& each : plain.asked) was_there = was_there || distance(each, {20, 0, 0}) < 0.011;
  EXPECT_TRUE(was_there);
}

TEST(Mover, ChainSpeedAndZSpeedSlowTheWholeMove) {
  // Along x, with the sprockets to the right and left, a chain runs as fast as the sled.
  Plain level({100, 10, 8, 0.66f, 0.05f}), deep;
  level.mover.setSprockets({{-1000, 0}, {1000, 0}, {0.02f, 0, 0}});
  level.lineTo(40, 0);
  level.run();
  EXPECT_NEAR(8 / 1.02, largest(level.speeds()), 0.02);
  // Across that direction hardly any chain runs at all, and the feed is kept.
  Plain across({100, 10, 8, 0.66f, 0.05f});
  across.mover.setSprockets({{-1000, 0}, {1000, 0}, {0.02f, 0, 0}});
  across.lineTo(0, 40);
  across.run();
  EXPECT_NEAR(15, largest(across.speeds()), 0.02);
  deep.lineTo(10, 0, -5);
  deep.run();
  EXPECT_NEAR(0.66 * std::sqrt(125) / 5, largest(deep.speeds()), 0.01);
  EXPECT_EQ(toCounts(-5.0f), deep.now.z);
}

TEST(Mover, MovesOneChainByALengthAtASpeed) {
  Plain plain;
  plain.mover.standAt({toCounts(1500.0f), toCounts(1700.0f), 0});
  const Point<float> from = {1500, 1700}, to = {1540, 1700};
  EXPECT_EQ(Added::kYes, plain.mover.add(line(from, to), 0, 13.3f, Space::kChains));
  plain.inverse = [](Point<float>) -> Lengths<float> { return {0, 0, false}; };  // is not asked
  plain.run();
  for (const Asked& each : plain.asked) EXPECT_NEAR(1700, each.y, 1e-4);
  EXPECT_EQ(toCounts(1540.0f), plain.now.left);
  EXPECT_NEAR(double(plain.asked.size()) * kTick, trapezoid(40, 13.3, 100), 0.05);
}

TEST(Mover, AMillionShortMovesEndWhereTheyWereCommanded) {
  Plain plain;
  std::mt19937 random(5);
  std::uniform_real_distribution<float> step(-0.2f, 0.2f);
  for (int i = 0; i < 1000000; ++i) {
    plain.lineTo(plain.at.x * 0.999f + step(random), plain.at.y * 0.999f + step(random));
    plain.asked.clear();
  }
  plain.run();
  EXPECT_EQ(toCounts(plain.at.x), plain.now.left);
  EXPECT_EQ(toCounts(plain.at.y), plain.now.right);
}

TEST(Mover, ALateStreamEndsTheBraking) {
  // A move at a time; the next comes just while the last brakes.
  Plain plain;
  for (int i = 1; i <= 40; ++i) {
    plain.lineTo(float(3 * i), 0);
    for (int t = 0; t < 20; ++t) plain.tick();
  }
  plain.run();
  const std::vector<double> speeds = plain.speeds();
  for (std::size_t i = 30; i + 60 < speeds.size(); ++i) EXPECT_GT(speeds[i], 5) << i;
  EXPECT_LE(hardest(plain), 250);
  EXPECT_EQ(toCounts(120.0f), plain.now.left);
}

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

namespace {

/// The least number of ticks for which lastsLonger() is false.
int predicted(const Plain& plain) {
  int low = 0, high = MoveQueue::kMostTold;
  while (low < high) {
    const int middle = (low + high) / 2;
    if (plain.mover.lastsLonger(uint16_t(middle)))
      low = middle + 1;
    else
      high = middle;
  }
  return low;
}

/// Ticks until all moves are done, without those in the ring.
int taken(Plain plain) {
  const int waiting = plain.set_points.count();
  plain.asked.clear();
  plain.run();
  return int(plain.asked.size()) - 1 - waiting;
}

}  // namespace

TEST(Duration, OfRandomMovesIsPredicted) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> any(0, 1);
  for (int round = 0; round < 200; ++round) {
    Plain plain;
    const float size = std::pow(10.0f, -1 + 3 * any(random));
    for (int i = 0; i < MoveQueue::kMost; ++i)
      plain.lineTo(size * any(random), size * any(random), 0, 1 + 19 * any(random));
    for (int tick = int(100 * any(random)); tick > 0; --tick) plain.tick();
    const int is = std::min(taken(plain), int(MoveQueue::kMostTold));
    EXPECT_NEAR(is, predicted(plain), 0.03 * is + 6) << size;
  }
}

TEST(Duration, OfAnEmptyQueueIsZero) {
  Plain plain;
  EXPECT_FALSE(plain.mover.lastsLonger(0));
  plain.lineTo(0.01f, 0);
  EXPECT_TRUE(plain.mover.lastsLonger(0));
}
