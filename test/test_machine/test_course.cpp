// The table of states: its laws over all states and events; and the overrides.
#include <gtest/gtest.h>

#include "machine/course.h"
#include "machine/overrides.h"

using namespace machine;
using gcode::Quick;

namespace {

/// All of an enum whose last value is kCount.
template <class Enum>
std::vector<Enum> all() {
  std::vector<Enum> values;
  for (int i = 0; i < int(Enum::kCount); ++i) values.push_back(Enum(i));
  return values;
}

bool isHaltedIn(State state) { return state >= State::kHalted; }

}  // namespace

TEST(Course, CanStopAndFailInEveryState) {
  for (const State state : all<State>()) {
    EXPECT_EQ(State::kStopping, Course::after(state, Event::kStop)) << int(state);
    const bool has_failed = state == State::kFalling || state == State::kAlarm;
    EXPECT_EQ(has_failed ? State::kCount : State::kFalling, Course::after(state, Event::kAlarm))
        << int(state);
  }
}

TEST(Course, CanHoldWheneverSomethingMoves) {
  for (const State state : all<State>()) {
    const State held = Course::after(state, Event::kHold);
    if (Course::pathGoesIn(state) || state == State::kLowering) {
      EXPECT_NE(State::kCount, held) << int(state);
    }
    if (held == State::kCount) continue;
    EXPECT_FALSE(Course::pathGoesIn(held)) << int(state);
  }
}

TEST(Course, PathRunsOnlyWhileRunningJoggingOrHalted) {
  for (const State state : all<State>())
    EXPECT_EQ(state == State::kRunning || state == State::kJogging || state == State::kHalted,
              Course::pathGoesIn(state));
}

TEST(Course, OnlyAStopOpensAHalt) {
  for (const State state : all<State>())
    for (const Event event : all<Event>()) {
      const State next = Course::after(state, event);
      if (!isHaltedIn(state) || event == Event::kStop || next == State::kCount) continue;
      EXPECT_TRUE(isHaltedIn(next)) << int(state) << " " << int(event);
    }
}

TEST(Course, RunsAgainOnceZIsBackOrEverythingStands) {
  for (const State state : all<State>())
    for (const Event event : all<Event>())
      if (Course::after(state, event) == State::kRunning) {
        const bool has_stood = event == Event::kStood && state < State::kHalted;
        const bool is_checked = event == Event::kCheck && state == State::kChecking;
        EXPECT_TRUE(event == Event::kBack || has_stood || is_checked)
            << int(state) << " " << int(event);
      }
}

TEST(Course, EndsAPauseOnlyByResumeOrStopOrFault) {
  EXPECT_EQ(State::kHeld, Course::after(State::kPaused, Event::kHold));
  for (const State state : {State::kHeld, State::kPaused}) {
    EXPECT_EQ(State::kResuming, Course::after(state, Event::kResume));
    for (const Event event : {Event::kPause, Event::kLower, Event::kBack, Event::kStood})
      EXPECT_EQ(State::kCount, Course::after(state, event));
  }
}

TEST(Course, RunsTheOperatorsLinesOnlyWhileThePathStands) {
  for (const State state : all<State>()) {
    const bool is_operators = Course::linesIn(state) == Lines::kOperator;
    EXPECT_EQ(state == State::kHeld || state == State::kPaused, is_operators) << int(state);
    EXPECT_EQ(state == State::kRunning, Course::linesIn(state) == Lines::kProgram) << int(state);
    EXPECT_EQ(state == State::kHalted || state == State::kAlarm,
              Course::linesIn(state) == Lines::kQuestions)
        << int(state);
  }
}

TEST(Course, AcceptsOnlyTheLinesThatFitItsState) {
  for (const State state : all<State>()) {
    const uint8_t lines = uint8_t(Course::linesIn(state));
    const bool runs = state == State::kRunning, jogs = state == State::kJogging;
    const bool checks = state == State::kChecking;
    EXPECT_EQ(runs || jogs, (lines & kJog) != 0) << int(state);
    EXPECT_EQ(runs || checks, (lines & kCheck) != 0) << int(state);
    if (jogs || checks) {
      EXPECT_EQ(0, lines & (kAct | kSetting)) << int(state);
    }
  }
  EXPECT_FALSE(Course::pathGoesIn(State::kChecking));
}

TEST(Overrides, FeedStepsBetweenItsLimits) {
  Overrides all;
  EXPECT_EQ(100, all.feed());
  EXPECT_FALSE(all.take(Quick::kFeedUsual));
  for (int i = 0; i < 12; ++i) all.take(Quick::kFeedUp);
  EXPECT_EQ(200, all.feed());
  EXPECT_FALSE(all.take(Quick::kFeedUpOne));
  EXPECT_FLOAT_EQ(2, all.boost());
  EXPECT_FLOAT_EQ(1, all.shareOfPlan());
  EXPECT_TRUE(all.take(Quick::kFeedDownOne));
  EXPECT_EQ(199, all.feed());
  EXPECT_TRUE(all.take(Quick::kFeedUsual));
  for (int i = 0; i < 12; ++i) all.take(Quick::kFeedDown);
  EXPECT_EQ(10, all.feed());
  EXPECT_FALSE(all.take(Quick::kFeedDownOne));
  EXPECT_FLOAT_EQ(1, all.boost());
  EXPECT_FLOAT_EQ(0.1f, all.shareOfPlan());
  EXPECT_TRUE(all.take(Quick::kFeedUpOne));
  EXPECT_EQ(11, all.feed());
  EXPECT_EQ(100, all.spindle());
}

TEST(Overrides, RapidsHaveThreeSteps) {
  Overrides all;
  EXPECT_FALSE(all.take(Quick::kRapidFull));
  EXPECT_TRUE(all.take(Quick::kRapidQuarter));
  EXPECT_EQ(25, all.rapid());
  EXPECT_TRUE(all.take(Quick::kRapidHalf));
  EXPECT_EQ(50, all.rapid());
  EXPECT_FALSE(all.take(Quick::kNoOverride));
  EXPECT_EQ(50, all.rapid());
  EXPECT_EQ(100, all.feed());
}

TEST(Overrides, SpindleStepsLikeTheFeedAndAllResetAtOnce) {
  Overrides all;
  EXPECT_FALSE(all.reset());
  EXPECT_TRUE(all.take(Quick::kSpindleUp));
  EXPECT_TRUE(all.take(Quick::kSpindleDownOne));
  EXPECT_EQ(109, all.spindle());
  EXPECT_EQ(100, all.feed());
  EXPECT_TRUE(all.reset());
  EXPECT_EQ(100, all.spindle());
}
