// Playback by itself: two shares at once, its step ahead, and rest.
#include <gtest/gtest.h>

#include "plain.h"

using namespace motion;

namespace {

const uint8_t kAhead = 4;  // [ticks]

/// A motion along x at 15 mm/s, 0.15 mm a tick, which may change by 0.01 mm each tick.
Plain cruising() {
  Plain plain;
  plain.lineTo(500, 0);
  for (int i = 0; i < 200; ++i) plain.tick();
  return plain;
}

double speedAfter(Plain& plain, int ticks) {
  for (int i = 0; i < ticks; ++i) plain.tick();
  return plain.speeds().back();
}

/// [mm] along x.
double stepAhead(const Plain& plain) {
  return toMm<double>(plain.playback.stepAhead(plain.set_points, kAhead).left);
}

}  // namespace

TEST(Yielding, MultipliesWithTheCommandedShare) {
  Plain plain = cruising();
  plain.playback.yieldTo(128);
  EXPECT_NEAR(7.5, speedAfter(plain, 60), 0.03);
  plain.playback.goAt(128);
  EXPECT_NEAR(3.75, speedAfter(plain, 60), 0.03);
  plain.playback.yieldTo(256);
  EXPECT_NEAR(7.5, speedAfter(plain, 60), 0.03);
  plain.playback.goAt(256);
  EXPECT_NEAR(15, speedAfter(plain, 60), 0.03);
}

TEST(StepAhead, IsZeroWhenHeldBeforeTheStart) {
  Plain plain;
  plain.playback.hold();
  plain.lineTo(10, 0);
  plain.tick();
  EXPECT_FALSE(plain.set_points.isEmpty());
  EXPECT_EQ(0, stepAhead(plain));
  EXPECT_TRUE(plain.playback.isDone()) << "nothing is taken";
}

TEST(Share, StaysAtRestWithoutSetPoints) {
  Plain plain;
  plain.playback.goAt(128);
  EXPECT_FALSE(plain.tickAlone());
  plain.lineTo(3, 0);
  plain.run();
  EXPECT_FALSE(plain.tickAlone());
  EXPECT_TRUE(plain.playback.isAtRest());
  EXPECT_TRUE(plain.playback.isDone());
}

TEST(Share, BringsEveryPathToItsEnd) {
  for (uint16_t share = 1; share <= Playback::kAllOfIt; ++share)
    for (int length = 1; length <= 21; ++length) {
      Plain plain;
      plain.playback.goAt(share);
      const float to = float(length) * float(length) * 0.01f;
      plain.lineTo(0, 0, to, 0.66f);
      plain.lineTo(to, 0, to);
      int most = 4000 + 512 * 900 / share;  // [ticks] a count may be half of a slow share
      do {
        plain.tick();
      } while (--most > 0 && !(plain.set_points.isEmpty() && plain.playback.isDone()));
      ASSERT_NEAR(to, plain.asked.back().x, 1e-3) << share << "/256 of " << to << " mm";
      ASSERT_NEAR(to, plain.asked.back().z, 1e-3) << share << "/256 of " << to << " mm";
    }
}
