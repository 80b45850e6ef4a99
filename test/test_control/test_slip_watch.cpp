// A load that drops away for a moment raises a suspicion; an even load, a ramp or the other chain
// does not.
#include <gtest/gtest.h>

#include "axis.h"

using motion::Pace;
using motion::SlipWatch;

namespace {

const int kCalm = 48;  // [ticks]

/// Counts the suspicions in some ticks at a duty.
int suspicions(SlipWatch& watch, int ticks, int duty, bool is_even = true) {
  int count = 0;
  for (int i = 0; i < ticks; ++i) {
    watch.measure(int16_t(duty));
    count += watch.look(is_even);
  }
  return count;
}

SlipWatch calmAt(int duty, int ticks = 200) {
  SlipWatch watch;
  EXPECT_EQ(0, suspicions(watch, ticks, duty, false));
  EXPECT_EQ(0, suspicions(watch, kCalm, duty));
  return watch;
}

}  // namespace

// After six ticks of a step the mean over four ticks has 0.82 of it, that over sixteen 0.32.
TEST(SlipWatch, SuspectsAJumpOfFifteenStepsTowardsPayingOut) {
  for (const int duty : {-200, 0, 150}) {
    SlipWatch more = calmAt(duty), less = calmAt(duty), back = calmAt(duty);
    EXPECT_EQ(1, suspicions(more, 8, duty + 15)) << duty;
    EXPECT_EQ(0, suspicions(less, 100, duty + 13)) << duty;
    EXPECT_EQ(0, suspicions(back, 100, duty - 50)) << duty;
  }
}

TEST(SlipWatch, IgnoresALateEdge) {
  SlipWatch watch = calmAt(100);
  EXPECT_EQ(0, suspicions(watch, 1, 115) + suspicions(watch, 1, 111) + suspicions(watch, 1, 94) +
                   suspicions(watch, 30, 100));
}

TEST(SlipWatch, LooksOnlyAfterFortyEightEvenTicks) {
  SlipWatch soon;
  suspicions(soon, 200, 100, false);
  EXPECT_EQ(0, suspicions(soon, kCalm - 6, 100) + suspicions(soon, 6, 140));
  SlipWatch due;
  suspicions(due, 200, 100, false);
  EXPECT_EQ(0, suspicions(due, kCalm, 100));
  EXPECT_EQ(1, suspicions(due, 6, 140));
  SlipWatch uneven = calmAt(100);
  EXPECT_EQ(0, suspicions(uneven, 1, 100, false) + suspicions(uneven, 30, 140));
}

TEST(SlipWatch, SuspectsAJumpOnlyOnce) {
  SlipWatch watch = calmAt(100);
  EXPECT_EQ(1, suspicions(watch, 30, 130));
  EXPECT_EQ(0, suspicions(watch, 200, 130));
  EXPECT_EQ(1, suspicions(watch, 30, 160));
}

// A steady ramp of r steps a tick parts the two means by 12 r.
TEST(SlipWatch, IgnoresALoadThatChangesSlowly) {
  for (const int ticks_a_step : {2, 1}) {
    SlipWatch watch = calmAt(-200);
    int count = 0;
    for (int i = 0; i < 200; ++i) count += suspicions(watch, 1, -200 + i / ticks_a_step);
    EXPECT_EQ(ticks_a_step == 1, count > 0) << ticks_a_step;
  }
}

TEST(SlipWatch, StartsAgainAfterATugTowardsWindingIn) {
  SlipWatch watch = calmAt(100), gentle = calmAt(100);
  EXPECT_EQ(0, suspicions(watch, 6, 82) + suspicions(watch, 12, 125));
  EXPECT_EQ(1, suspicions(gentle, 6, 88) + suspicions(gentle, 12, 125));
}

TEST(SlipWatch, IsUnsteadyWhileTheDutyJumps) {
  for (const int jump : {12, -12, 9, -9}) {
    SlipWatch watch = calmAt(100);
    EXPECT_FALSE(watch.isRestless());
    bool was_restless = false;
    for (int i = 0; i < 8; ++i) {
      suspicions(watch, 1, 100 + jump);
      was_restless |= watch.isRestless();
    }
    EXPECT_EQ(std::abs(jump) == 12, was_restless) << jump;
    suspicions(watch, 100, 100 + jump);
    EXPECT_FALSE(watch.isRestless());
  }
}

// The mean over sixteen ticks is fifteen ticks late.
TEST(Pace, IsKeptUpToAChangeOfTwelveCountsATick) {
  for (const int sign : {-1, 1})
    for (const int gain : {12, 14}) {
      Pace pace;
      bool is_kept = true;
      for (int i = 0; i < 200; ++i) is_kept = pace.isKept(sign * gain * i);
      EXPECT_EQ(gain == 12, is_kept) << sign * gain;
    }
}

TEST(Pace, RecoversFromAnyState) {
  Pace pace;
  for (const int32_t way : {1000000000, -1000000000}) {
    EXPECT_FALSE(pace.isKept(way));
    for (int i = 0; i < 200; ++i) pace.isKept(way);
    EXPECT_TRUE(pace.isKept(way));
    EXPECT_FALSE(pace.isKept(-way));
    for (int i = 0; i < 200; ++i) pace.isKept(0);
    EXPECT_TRUE(pace.isKept(0));
  }
}
