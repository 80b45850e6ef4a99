// Which axis a fault names, and which faults prove its counts wrong.
#include <gtest/gtest.h>

#include <array>

#include "machine/axes.h"
#include "set_counts.h"
#include "settings_flash.h"

using namespace machine;

namespace {

/// Axes that follow, at zero.
struct Faults : testing::Test {
  Faults() : values(table, room), axes(motors, clock) {
    axes.prepare(values);
    axes.follow();
  }

  void tick(int ticks) {
    for (; ticks > 0; --ticks) axes.tick();
  }

  /// It turns the way it is driven, but too slowly.
  void leaveRightBehind() {
    for (int i = 1; i <= 12; ++i) {
      axes.jumpTo(kRightAxis, 0.25f * float(i));
      motors.counted[kRightAxis] = uint16_t(motors.counted[kRightAxis] + 8);
      tick(1);
    }
  }

  FlashTable table;
  float room[kSettingCount];
  settings::Values values;
  SetCounts motors;
  NoClock clock;
  Axes axes;
};

}  // namespace

TEST_F(Faults, AnAxisThatStandsIsDisprovedAlone) {
  axes.jumpTo(kLeftAxis, 50);
  tick(120);
  EXPECT_EQ(motion::Fault::kStands, axes.fault().fault);
  EXPECT_TRUE(axes.isDisproved(kLeftAxis));
  EXPECT_FALSE(axes.isDisproved(kRightAxis));
  EXPECT_FALSE(axes.isDisproved(kZAxis));
}

TEST_F(Faults, AnAxisThatIsLeftBehindIsNotDisproved) {
  leaveRightBehind();
  const Axes::AxisFault worst = axes.fault();
  EXPECT_EQ(motion::Fault::kLeftBehind, worst.fault);
  EXPECT_EQ(kRightAxis, worst.axis);
  EXPECT_FALSE(axes.isDisproved(kRightAxis));
}

TEST_F(Faults, TheWorstIsTold) {
  axes.jumpTo(kLeftAxis, 50);
  tick(120);
  leaveRightBehind();
  const Axes::AxisFault worst = axes.fault();
  EXPECT_EQ(motion::Fault::kStands, worst.fault) << "the right axis is left behind later";
  EXPECT_EQ(kLeftAxis, worst.axis);
}

TEST_F(Faults, ANewStartForgetsThem) {
  axes.jumpTo(kLeftAxis, 50);
  tick(120);
  axes.releaseAll();
  axes.standStill();
  axes.follow();
  EXPECT_EQ(motion::Fault::kNone, axes.fault().fault);
  EXPECT_FALSE(axes.isDisproved(kLeftAxis));
}
