// Which axis a fault speaks of, and which faults say that its counts are wrong.
#include <gtest/gtest.h>

#include <array>

#include "machine/axes.h"
#include "settings_flash.h"

using namespace machine;

namespace {

/// Motors that turn by as many counts a tick as they are told to, whatever their duty.
struct Motors : Drives {
  void drive(Axis, int16_t) override {}
  void release(Axis) override {}
  uint16_t count(Axis axis) override { return counted[axis]; }
  uint16_t illegalSteps(Axis) override { return 0; }
  void arrange(bool, uint8_t) override {}
  std::array<uint16_t, kAxisCount> counted{};
};

struct NoClock : Clock {
  uint32_t milliseconds() override { return 0; }
  void idle() override {}
  void holdTicks() override {}
  void releaseTicks() override {}
};

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
  Motors motors;
  NoClock clock;
  Axes axes;
};

}  // namespace

TEST_F(Faults, AnAxisThatStandsIsDisprovedAlone) {
  axes.jumpTo(kLeftAxis, 50);
  tick(120);
  EXPECT_EQ(motion::Fault::kStands, axes.fault());
  EXPECT_TRUE(axes.isDisproved(kLeftAxis));
  EXPECT_FALSE(axes.isDisproved(kRightAxis));
  EXPECT_FALSE(axes.isDisproved(kZAxis));
}

TEST_F(Faults, AnAxisThatIsLeftBehindIsNotDisproved) {
  leaveRightBehind();
  EXPECT_EQ(motion::Fault::kLeftBehind, axes.fault());
  EXPECT_FALSE(axes.isDisproved(kRightAxis));
}

TEST_F(Faults, TheWorstIsTold) {
  axes.jumpTo(kLeftAxis, 50);
  tick(120);
  leaveRightBehind();
  EXPECT_EQ(motion::Fault::kStands, axes.fault()) << "the right axis is left behind later";
}

TEST_F(Faults, ANewStartForgetsThem) {
  axes.jumpTo(kLeftAxis, 50);
  tick(120);
  axes.releaseAll();
  axes.standStill();
  axes.follow();
  EXPECT_EQ(motion::Fault::kNone, axes.fault());
  EXPECT_FALSE(axes.isDisproved(kLeftAxis));
}
