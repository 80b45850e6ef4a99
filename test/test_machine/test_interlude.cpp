// While the program waits: whose lines count, and when the wait ends. Also the feed override.
#include <gtest/gtest.h>

#include "machine/feed_override.h"
#include "machine/interlude.h"

using namespace machine;
using gcode::Quick;

TEST(Interlude, TakesLinesThatComeAfterItsFirstMoments) {
  Interlude interlude;
  EXPECT_FALSE(interlude.takesLines(0, true));
  interlude.hold({}, 1000, true);
  EXPECT_FALSE(interlude.takesLines(1000, true));
  EXPECT_FALSE(interlude.takesLines(1299, true));
  EXPECT_TRUE(interlude.takesLines(1300, false));
  interlude.resume();
  EXPECT_FALSE(interlude.takesLines(1400, false));
}

TEST(Interlude, LeavesTheProgramsLinesWaiting) {
  Interlude interlude;
  interlude.pause({}, 1000, false);
  EXPECT_FALSE(interlude.takesLines(5000, false));
  interlude.end();
  interlude.pause({}, 6000, true);
  EXPECT_FALSE(interlude.takesLines(6100, false));
  EXPECT_FALSE(interlude.takesLines(9000, true));
}

TEST(Interlude, DoesOneLineAtATime) {
  Interlude interlude;
  interlude.hold({}, 0, true);
  EXPECT_TRUE(interlude.takesLines(400, false));
  interlude.serve(true);
  EXPECT_FALSE(interlude.takesLines(500, false));
  interlude.serve(false);
  EXPECT_TRUE(interlude.takesLines(600, false));
}

TEST(Interlude, EndsOnceResumedAndKeepsTheProgramsModes) {
  Interlude interlude;
  interlude.resume();
  EXPECT_FALSE(interlude.isEnding());
  gcode::Modal modal;
  modal.motion = 3;
  interlude.hold(modal, 0, true);
  gcode::Modal later;
  interlude.pause(later, 10, true);
  EXPECT_EQ(3, interlude.modal().motion);
  EXPECT_TRUE(interlude.isOn() && interlude.isPaused() && !interlude.isEnding());
  interlude.resume();
  EXPECT_TRUE(interlude.isEnding());
  EXPECT_TRUE(interlude.beginsLowering());
  EXPECT_FALSE(interlude.beginsLowering());
  interlude.end();
  EXPECT_FALSE(interlude.isOn() || interlude.isEnding());
}

TEST(FeedOverride, GoesInStepsBetweenItsEnds) {
  FeedOverride feed;
  EXPECT_EQ(100, feed.percent());
  EXPECT_FALSE(feed.take(Quick::kFeedUsual));
  for (int i = 0; i < 12; ++i) feed.take(Quick::kFeedUp);
  EXPECT_EQ(200, feed.percent());
  EXPECT_FALSE(feed.take(Quick::kFeedUpOne));
  EXPECT_FLOAT_EQ(2, feed.boost());
  EXPECT_FLOAT_EQ(1, feed.shareOfPlan());
  EXPECT_TRUE(feed.take(Quick::kFeedDownOne));
  EXPECT_EQ(199, feed.percent());
  EXPECT_TRUE(feed.take(Quick::kFeedUsual));
  for (int i = 0; i < 12; ++i) feed.take(Quick::kFeedDown);
  EXPECT_EQ(10, feed.percent());
  EXPECT_FALSE(feed.take(Quick::kFeedDownOne));
  EXPECT_FLOAT_EQ(1, feed.boost());
  EXPECT_FLOAT_EQ(0.1f, feed.shareOfPlan());
  EXPECT_TRUE(feed.take(Quick::kFeedUpOne));
  EXPECT_EQ(11, feed.percent());
  EXPECT_FALSE(feed.take(Quick::kStop));
}
