// The queue's estimate of its moves' duration, against the ticks they then take.
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
