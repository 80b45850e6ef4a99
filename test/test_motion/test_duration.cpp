// How long the queue says that its moves last, against the ticks that they then take.
#include <gtest/gtest.h>

#include <random>

#include "plain.h"

using namespace motion;

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

TEST(Duration, IsThatOfALongMoveAtAnyMomentOfIt) {
  for (const double seconds : {0.01, 0.005}) {
    Plain plain(kGentle, seconds);
    plain.lineTo(60, 0);
    for (int i = 0; i < 800; i += 40) {
      EXPECT_NEAR(taken(plain), predicted(plain), 2) << i;
      for (int tick = 0; tick < 40; ++tick) plain.tick();
    }
  }
}

TEST(Duration, IsThatOfAnyMovesTogether) {
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

TEST(Duration, OfNothingIsNothing) {
  Plain plain;
  EXPECT_FALSE(plain.mover.lastsLonger(0));
  plain.lineTo(0.01f, 0);
  EXPECT_TRUE(plain.mover.lastsLonger(0));
}

TEST(Duration, OfShortMovesIsLessThanTheirStopsWouldTake) {
  Plain plain;
  // A smooth row: 16 moves of 0.5 mm take 0.7 s, with a stop at each end 2.2 s.
  for (int i = 1; i <= MoveQueue::kMost; ++i) plain.lineTo(float(i) * 0.5f, 0);
  EXPECT_FALSE(plain.mover.lastsLonger(75));
  EXPECT_TRUE(plain.mover.lastsLonger(60));
}

TEST(Ring, TellsHowManyWait) {
  SetPoints points;
  Leg point = {{0, 0, 0}, 1, 1, 0};
  for (int round = 0; round < 30; ++round) {
    for (int i = 0; i < SetPoints::kMost - round % 3; ++i) {
      EXPECT_EQ(i, points.count());
      points.push(point);
    }
    while (points.count() != 0) points.take(point);
    EXPECT_TRUE(points.isEmpty());
  }
}
