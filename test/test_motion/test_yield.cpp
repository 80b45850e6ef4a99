// The share of its speed that a machine keeps when it falls behind.
#include <Motion.h>
#include <gtest/gtest.h>

using namespace motion;

TEST(Yield, IsFullSpeedUpToHalfTheLimitThenFallsEvenly) {
  Yield yield;
  yield.tune(2);
  EXPECT_EQ(256, yield.shareAt(0));
  EXPECT_EQ(256, yield.shareAt(toCounts(1.0f)));
  EXPECT_NEAR(256 - 115, yield.shareAt(toCounts(1.4f)), 1);
  EXPECT_EQ(26, yield.shareAt(toCounts(1.81f)));
  EXPECT_EQ(26, yield.shareAt(toCounts(2000.0f)));
  uint16_t last = 256;
  for (int32_t off = 0; off < toCounts(3.0f); off += 100) {
    EXPECT_LE(yield.shareAt(off), last);
    EXPECT_LE(last - yield.shareAt(off), 2);
    last = yield.shareAt(off);
  }
}

TEST(Yield, FollowsTheLimitAndIsOffWithoutALimit) {
  Yield yield;
  yield.tune(10);
  EXPECT_EQ(256, yield.shareAt(toCounts(5.0f)));
  EXPECT_EQ(26, yield.shareAt(toCounts(9.1f)));
  yield.tune(2000);
  EXPECT_EQ(256, yield.shareAt(toCounts(3000.0f)));
  yield.tune(0.0001f);
  EXPECT_EQ(26, yield.shareAt(toCounts(1.0f)));
}
