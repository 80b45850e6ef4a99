// Which axis a fault names, and which faults prove its counts wrong.
#include <gtest/gtest.h>

#include "prepared_axes.h"

using namespace machine;

namespace {

/// Axes that follow, at zero.
struct Faults : testing::Test, PreparedAxes<BoardAtRest> {
  Faults() { axes.follow(); }

  /// It turns the way it is driven, but too slowly.
  void leaveRightBehind() {
    for (int i = 1; i <= 12; ++i) {
      axes.jumpTo(kRightAxis, 0.25f * float(i));
      board.counted[kRightAxis] = uint16_t(board.counted[kRightAxis] + 8);
      ticks(1);
    }
  }
};

}  // namespace

TEST_F(Faults, OnlyTheAxisThatStandsLosesItsCounts) {
  axes.jumpTo(kLeftAxis, 50);
  ticks(120);
  EXPECT_EQ(motion::Fault::kStands, axes.fault().fault);
  EXPECT_TRUE(axes.isDisproved(kLeftAxis));
  EXPECT_FALSE(axes.isDisproved(kRightAxis));
  EXPECT_FALSE(axes.isDisproved(kZAxis));
}

TEST_F(Faults, AnAxisThatIsLeftBehindKeepsItsCounts) {
  leaveRightBehind();
  const Axes::AxisFault worst = axes.fault();
  EXPECT_EQ(motion::Fault::kLeftBehind, worst.fault);
  EXPECT_EQ(kRightAxis, worst.axis);
  EXPECT_FALSE(axes.isDisproved(kRightAxis));
}

TEST_F(Faults, TheWorstIsReported) {
  axes.jumpTo(kLeftAxis, 50);
  ticks(120);
  leaveRightBehind();
  const Axes::AxisFault worst = axes.fault();
  EXPECT_EQ(motion::Fault::kStands, worst.fault) << "the right axis is left behind later";
  EXPECT_EQ(kLeftAxis, worst.axis);
}

TEST_F(Faults, ANewStartForgetsThem) {
  axes.jumpTo(kLeftAxis, 50);
  ticks(120);
  axes.releaseAll();
  axes.standStill();
  axes.follow();
  EXPECT_EQ(motion::Fault::kNone, axes.fault().fault);
  EXPECT_FALSE(axes.isDisproved(kLeftAxis));
}
