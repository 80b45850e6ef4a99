// A move in the queue: its length, acceleration and speed over three axes, and the speed at which
// each corner is passed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "plain.h"

using namespace motion;

namespace {

const double kAlongSheet = 100, kAlongZ = 10, kZSpeed = 2;
const Limits kUnits = {float(kAlongSheet), float(kAlongZ), 1e6f, float(kZSpeed), 0.05f};

/// A queue whose ticks last a second, so that its speeds are in mm/s.
struct Queued {
  explicit Queued(const Limits& limits = kUnits) {
    queue.prepare(limits, 1);
    queue.setSprockets({{-1e6f, 1e6f}, {1e6f, 1e6f}, {0, 0, 0}});
  }

  void lineBy(float dx, float dy, float dz, float feed = 30) {
    add(line(at, {at.x + dx, at.y + dy}), dz, feed);
  }
  void add(const Path<float>& path, float dz, float feed = 30, bool is_rapid = false) {
    EXPECT_EQ(Added::kYes, queue.add(path, z, z + dz, feed, Space::kSheet, 0, is_rapid));
    at = path.to;
    z += dz;
  }
  /// The move that is `index` places behind the first.
  const Move& move(int index) {
    for (; dropped < index; ++dropped) queue.dropFirst();
    return queue.first();
  }

  MoveQueue queue;
  Point<float> at = {5, 7};
  float z = 3;
  int dropped = 0;
};

struct Shift {
  float dx, dy, dz;
};

Direction directionOf(const Shift& way) {
  const float length = std::sqrt(way.dx * way.dx + way.dy * way.dy + way.dz * way.dz);
  return {way.dx / length, way.dy / length, way.dz / length};
}

bool isOfZ(const Shift& shift) { return shift.dx == 0 && shift.dy == 0; }

}  // namespace

TEST(Queue, MoveKeepsTheLimitsOfTheSheetAndOfZ) {
  for (const Shift& way : {Shift{3, 0, 0},
                           {0, 0, 4},
                           {0, 0, -0.5f},
                           {3, 0, 4},
                           {4, 0, -3},
                           {0, 3, 4},
                           {40, 0, 0.3f},
                           {24, 32, 3},
                           {-24, 32, -9},
                           {1, 0, 0},
                           {0, 1, 1}}) {
    Queued queued;
    queued.lineBy(way.dx, way.dy, way.dz);
    const double across = std::hypot(double(way.dx), double(way.dy)), rise = std::fabs(way.dz);
    const double length = std::hypot(across, rise);
    const Move& move = queued.move(0);
    EXPECT_NEAR(double(move.length), length, 1e-5 * length) << way.dx << " " << way.dz;
    double acceleration = 1e9, top = 30;
    if (across > 0) acceleration = kAlongSheet * length / across;
    if (rise > 0) acceleration = std::min(acceleration, kAlongZ * length / rise);
    if (rise > 0) top = std::min(top, kZSpeed * length / rise);
    EXPECT_NEAR(double(move.acceleration), acceleration, 0.002 * acceleration)
        << way.dx << " " << way.dz;
    // In float the share of z follows from the share along the sheet.
    EXPECT_NEAR(double(move.top), top, 0.01 * top) << way.dx << " " << way.dz;
    EXPECT_EQ(0, move.entry_squared);
    EXPECT_EQ(0, move.beam) << "nobody asked for one";
  }
}

TEST(Queue, CornerIsThatOfBothDirectionsAndAStopBetweenZAndAPath) {
  // Long moves, and moves so short that each corner is spread over them.
  const Shift ways[] = {{10, 0, 0}, {10, 3, 0},         {0, 8, 6},     {0, 0, -5}, {6, 0, -8},
                        {3, 0, 1},  {0.02f, 0.006f, 0}, {0.02f, 0, 0}, {-3, 4, 0}};
  for (const Shift& before : ways)
    for (const Shift& after : ways) {
      Queued queued;
      queued.lineBy(before.dx, before.dy, before.dz);
      queued.lineBy(after.dx, after.dy, after.dz);
      const Move first = queued.move(0), second = queued.move(1);
      const bool stops = isOfZ(before) != isOfZ(after);
      const float corner = cornerSpeedSquared(directionOf(before), directionOf(after),
                                              std::min(first.acceleration, second.acceleration),
                                              0.05f, (first.length + second.length) / 2);
      const float expected = stops ? 0 : corner;
      EXPECT_NEAR(double(second.corner_squared), double(expected), 0.002 * double(expected) + 1e-4)
          << before.dx << " " << before.dy << " " << before.dz << ", " << after.dx << " "
          << after.dy << " " << after.dz;
    }
}

TEST(Queue, CornerAtAnArcIsThatOfItsEnd) {
  // A quarter round (0, 10): it sets out to the right and arrives upwards.
  const Path<float> quarter = arc(Point<float>{0, 0}, {10, 10}, {0, 10}, Turn::kCounterclockwise);
  struct {
    const char* name;
    Shift before, after;  ///< the lines before and after it
    bool stops_before, stops_after;
  } cases[] = {{"smooth", {5, 0, 0}, {0, 5, 0}, false, false},
               {"a corner before it", {0, 5, 0}, {0, 5, 0}, true, false},
               {"a corner after it", {5, 0, 0}, {5, 0, 0}, false, true}};
  for (const auto& each : cases) {
    Queued queued;
    queued.at = {-each.before.dx, -each.before.dy};
    queued.lineBy(each.before.dx, each.before.dy, 0);
    queued.add(quarter, 0);
    queued.lineBy(each.after.dx, each.after.dy, 0);
    EXPECT_EQ(each.stops_before, queued.move(1).corner_squared < 100) << each.name;
    EXPECT_EQ(each.stops_after, queued.move(2).corner_squared < 100) << each.name;
  }
}

TEST(Queue, HelixPassesIntoLinesOfTheSameSlope) {
  const Path<float> quarter = arc(Point<float>{0, 0}, {10, 10}, {0, 10}, Turn::kCounterclockwise);
  const float rise = 5;
  const float per = rise / quarter.length;
  Queued queued;
  queued.at = {-10, 0};
  queued.lineBy(10, 0, 10 * per);
  queued.add(quarter, rise);
  queued.lineBy(0, 10, 10 * per);
  EXPECT_GT(queued.move(1).corner_squared, 100) << "as steep before it";
  EXPECT_GT(queued.move(2).corner_squared, 100) << "as steep after it";
}

TEST(Queue, LooksBackFromAStopAtTheEnd) {
  const double top = 15;
  Queued queued;
  // Along x: 2 a L is 200 for each mm; the second move's feed limits it.
  queued.lineBy(1, 0, 0, 30);
  queued.lineBy(0.25f, 0, 0, float(top));
  queued.lineBy(0.5f, 0, 0, 30);
  queued.lineBy(0.1f, 0, 0, 30);
  EXPECT_NEAR(double(queued.queue.exitSquared()), 200 * 0.85, 0.1);
  EXPECT_NEAR(double(queued.queue.second().entry_squared), 170, 0.1);
  queued.lineBy(1, 0, 0, 30);
  EXPECT_NEAR(double(queued.queue.exitSquared()), top * top, 0.1) << "no faster than its feed";
  EXPECT_EQ(0, queued.move(0).entry_squared);
  EXPECT_NEAR(double(queued.move(2).entry_squared), 200 * 1.6, 0.1);
  EXPECT_NEAR(double(queued.move(3).entry_squared), 200 * 1.1, 0.1);
  EXPECT_NEAR(double(queued.move(4).entry_squared), 200, 0.1);
  EXPECT_EQ(0, queued.queue.exitSquared());
}

TEST(Queue, LooksBackAgainWhenTheFeedIsBoosted) {
  Queued queued;
  queued.lineBy(10, 0, 0, 4);
  queued.lineBy(10, 0, 0, 4);
  EXPECT_NEAR(double(queued.queue.exitSquared()), 16, 1e-3);
  queued.queue.boost(2, 30);
  EXPECT_NEAR(double(queued.queue.exitSquared()), 64, 1e-3);
  queued.queue.boost(2, 5);
  EXPECT_NEAR(double(queued.queue.exitSquared()), 25, 1e-3) << "no more is made of it";
  queued.queue.boost(2, 3);
  EXPECT_NEAR(double(queued.queue.exitSquared()), 16, 1e-3) << "what was asked for stays";
  queued.queue.boost(0.5f, 30);
  EXPECT_NEAR(double(queued.queue.exitSquared()), 4, 1e-3);
}

TEST(Queue, SlowsRapidsWithoutSlowingFeeds) {
  Queued queued;
  queued.lineBy(10, 0, 0, 8);
  queued.add(line(queued.at, {queued.at.x + 10, queued.at.y}), 0, 8, true);
  queued.queue.boost(1, 8, 0.25f);
  EXPECT_NEAR(double(queued.queue.second().entry_squared), 4, 1e-3) << "a quarter of its feed";
  EXPECT_NEAR(double(queued.queue.first().top), 8, 1e-5);
  queued.queue.boost(2, 30, 0.5f);
  EXPECT_NEAR(double(queued.queue.second().top), 4, 1e-5) << "feeds alone are boosted";
  EXPECT_NEAR(double(queued.queue.first().top), 16, 1e-5);
}

TEST(Queue, IsFullAfterSixteenMovesAndWrapsAround) {
  Queued queued;
  for (int round = 1; round < 60; ++round) {
    while (queued.queue.hasRoom()) queued.lineBy(float(round), 0, 0);
    EXPECT_EQ(16, queued.queue.count());
    EXPECT_EQ(Added::kFull, queued.queue.add(line(queued.at, {0, 1}), 3, 3, 30, Space::kSheet));
    for (int i = 0; i < 5; ++i) queued.queue.dropFirst();
    EXPECT_EQ(11, queued.queue.count());
  }
  queued.queue.clear();
  EXPECT_TRUE(queued.queue.isEmpty());
  EXPECT_EQ(0, queued.queue.exitSquared());
}
