// How long each wait of the main program lasts, and what ends it.
#include "parts.h"

using namespace machine;

struct WaitingAlone : PartsAtRest {};

TEST_F(WaitingAlone, LastsItsTimeOrUntilAStop) {
  EXPECT_TRUE(waiting.waitFor(50));
  EXPECT_EQ(50, waiting.rounds);
  waiting.in_each_round = [&] {
    if (waiting.rounds == 60) waiting.stop();
  };
  EXPECT_FALSE(waiting.waitFor(50));
  EXPECT_EQ(60, waiting.rounds);
  EXPECT_FALSE(waiting.drain());
  EXPECT_FALSE(waiting.waitWhile([] { return true; }));
  EXPECT_EQ(60, waiting.rounds);
}

TEST_F(WaitingAlone, GivesUpAfterHalfASecondOnAMissingAxis) {
  axes.simulate(false);
  axes.jumpTo(kLeftAxis, axes.length(kLeftAxis) + 1);
  waiting.settle();
  EXPECT_EQ(500, waiting.rounds);
}

TEST_F(WaitingAlone, EndsOnceAxesAreNearTheirSetPoints) {
  axes.simulate(false);
  axes.jumpTo(kLeftAxis, axes.length(kLeftAxis) + 1);
  waiting.stop();
  waiting.awaitStandstill();
  EXPECT_EQ(20, waiting.rounds) << "an axis without power goes nowhere";
  axes.follow();
  waiting.rounds = 0;
  waiting.awaitStandstill();
  EXPECT_EQ(219, waiting.rounds) << "its encoder shows nothing";
}

TEST_F(WaitingAlone, GoesOnAfterTheLastSetPointUntilTheMotorsArrive) {
  axes.simulate(false);
  EXPECT_TRUE(moves.move(0, words("G0 Z-0.1")));
  int rounds_still = 0;
  waiting.in_each_round = [&] { rounds_still += !waiting.isMoving(); };
  EXPECT_TRUE(waiting.drain());
  EXPECT_NEAR(500, rounds_still, 2);
}

TEST_F(WaitingAlone, DoesNotWaitForAMotorWithoutPower) {
  axes.simulate(false);
  axes.jumpTo(kLeftAxis, axes.length(kLeftAxis) + 1);
  EXPECT_TRUE(waiting.drain());
  EXPECT_EQ(0, waiting.rounds) << "a motor without power never comes nearer";
}
