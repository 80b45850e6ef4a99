// A stop while a line waits for room, and when a test of the loops counts as running.
#include "parts.h"

using namespace machine;

struct MovesAlone : PartsAtRest {};

TEST_F(MovesAlone, WaitForRoomInTheQueueUntilAStop) {
  for (int i = 1; i <= 16; ++i) EXPECT_TRUE(moves.move(0, words(i % 2 ? "G0 X9" : "G0 X0")));
  waiting.rounds = 0;
  waiting.in_each_round = [&] {
    if (waiting.rounds == 5) waiting.stop();
  };
  bool was_stopped = false;
  for (int i = 0; i < 16 && !was_stopped; ++i)
    was_stopped = !moves.move(0, words(i % 2 ? "G0 X9" : "G0 X0"));
  EXPECT_TRUE(was_stopped);
  EXPECT_EQ(5, waiting.rounds);
}

struct AxisTestsAlone : PartsAtRest {};

TEST_F(AxisTestsAlone, CountAsTestingOnlyWhileTheyRun) {
  bool was_testing = false;
  waiting.in_each_round = [&] {
    was_testing = axis_tests.isTesting();
    if (board.now_ms > 3000) waiting.stop();
  };
  EXPECT_FALSE(axis_tests.testLoop(13, {kLeftAxis, 5, 5, 2, 0, 1}));
  EXPECT_TRUE(was_testing);
  EXPECT_FALSE(axis_tests.isTesting());
  EXPECT_FALSE(axes.isPowered() && axes.isDriven());
}
