// The watch's limits: how hard an axis must be driven, how little it must turn, for how long.
#include <Motion.h>
#include <gtest/gtest.h>

#include <ostream>
#include <sstream>
#include <string>

using motion::Fault;
using motion::Watch;

namespace {

std::ostream& operator<<(std::ostream& out, Fault fault) {
  const char* const names[] = {"none", "left behind", "stands", "turns back"};
  return out << names[int(fault)];
}

Watch watchOf(float limit) {
  Watch watch;
  watch.tune(limit, 8113.73f, 0.01f);
  watch.rest();
  return watch;
}

/// The fault of an axis that is too far from its set-point after half a second.
std::string leftBehindAfter(int duty, int moved) {
  Watch watch = watchOf(2);
  std::ostringstream said;
  for (int i = 0; i < 50; ++i) {
    const Fault early = watch.look(int16_t(duty), int16_t(moved), 0);
    if (early != Fault::kNone) said << "early: ";
  }
  said << watch.look(int16_t(duty), int16_t(moved), 2.01f);
  return said.str();
}

/// The tick at which an axis that turns against its drive is a fault; 0: never in a minute.
int turnsBackAfter(int duty, int moved) {
  Watch watch = watchOf(2);
  for (int i = 1; i <= 6000; ++i)
    if (watch.look(int16_t(duty), int16_t(moved), 0) == Fault::kTurnsBack) return i;
  return 0;
}

}  // namespace

TEST(WatchLimits, AnAxisStandsOnlyAtMoreThanHalfPower) {
  for (const int sign : {-1, 1}) {
    EXPECT_EQ("left behind", leftBehindAfter(sign * 126, 0));
    EXPECT_EQ("stands", leftBehindAfter(sign * 130, 0));
  }
}

TEST(WatchLimits, AnAxisThatTurnsIsLeftBehindRatherThanStanding) {
  for (const int sign : {-1, 1}) {
    EXPECT_EQ("stands", leftBehindAfter(sign * 135, sign));
    EXPECT_EQ("left behind", leftBehindAfter(sign * 135, sign * 3));
  }
}

TEST(WatchLimits, TurningBackIsAFaultAfterFifteenHundredthsOfASecond) {
  for (const int sign : {-1, 1}) {
    EXPECT_NEAR(turnsBackAfter(sign * 150, -sign * 20), 15 + 8, 5) << "ticks, " << sign;
    EXPECT_EQ(0, turnsBackAfter(sign * 100, -sign)) << "driven by less than half the power";
  }
}

TEST(WatchLimits, DistanceIsWatchedBothWaysAndALimitOf100MmTurnsItOff) {
  for (const float error : {-2.0f, 2.0f}) {
    Watch watch = watchOf(2);
    EXPECT_EQ(Fault::kNone, watch.look(0, 0, 0.99f * error)) << error;
    EXPECT_EQ(Fault::kLeftBehind, watch.look(0, 0, error)) << error;
  }
  EXPECT_EQ(Fault::kLeftBehind, watchOf(2).look(0, 0, NAN));
  Watch off = watchOf(100);
  EXPECT_EQ(Fault::kNone, off.look(0, 0, 150)) << "a limit of 100 mm is none";
  Watch on = watchOf(99);
  EXPECT_EQ(Fault::kLeftBehind, on.look(0, 0, 150)) << "a limit of 99 mm is watched";
}
