// How the control tick reacts to a chain that lets go of its motor for a moment, on motors with
// their loops.
#include <gtest/gtest.h>

#include <vector>

#include "machine/axes.h"
#include "settings_flash.h"
#include "world/motor.h"

using namespace machine;

namespace {

const double kSlipTick = 0.01;  // [s]
const int kSettles = 200;  // [ticks] until the watch looks: two means and a calm of half a second

const double kLoad = 0.96;  // [Nm] 95 N of chain at an arm of 10.1 mm

/// Motors that hold a sled in the middle of the sheet.
struct LoadedMotors : Drives {
  LoadedMotors() {
    world::MotorConstants constants;
    constants.load = kLoad;
    constants.count_noise = 0;  // so that each tug of the duty has a cause
    for (unsigned i = 0; i < kAxisCount; ++i) motors.emplace_back(constants, i + 1);
  }
  void drive(Axis axis, int16_t duty) override { duty_[axis] = duty; }
  void release(Axis axis) override { duty_[axis] = 0; }
  void brake(Axis axis) override { duty_[axis] = 0; }
  uint16_t count(Axis axis) override { return uint16_t(motors[axis].counts()); }
  uint16_t illegalSteps(Axis) override { return 0; }
  void arrange(bool, uint8_t) override {}

  void pass() {
    // A positive drive winds in.
    for (unsigned i = 0; i < kAxisCount; ++i) motors[i].run(-duty_[i], kSlipTick);
  }

  std::vector<world::Motor> motors;

 private:
  int duty_[kAxisCount] = {0, 0, 0};
};

/// Axes that go evenly, each at its speed.
struct Slips : testing::Test, Clock {
  Slips() : values_(table_, room_), axes(motors, *this) {
    values_.setRow(kZPositionP, 1300);
    axes.prepare(values_);
    axes.follow();
  }
  uint32_t milliseconds() override { return 0; }
  void idle() override {}
  void holdTicks() override {}
  void releaseTicks() override {}

  /// Goes on for some ticks, each axis by its way [mm/s].
  void go(int ticks) {
    for (; ticks > 0; --ticks) {
      while (axes.setPoints().hasRoom()) {
        for (int i = 0; i < kAxisCount; ++i)
          at_[i] += int32_t(mm_per_second[i] * kSlipTick * motion::kCountsPerMm);
        axes.setPoints().vacant() = {{at_[kLeftAxis], at_[kRightAxis], at_[kZAxis]}, 9000, 200, 0};
        axes.setPoints().push();
      }
      axes.tick();
      motors.pass();
    }
  }

  /// The chains let go of their motors for 30 ms, and what follows of it is over.
  void letGo(std::initializer_list<Axis> chains) {
    for (const Axis chain : chains) motors.motors[chain].pull = -kLoad;
    go(3);
    for (const Axis chain : chains) motors.motors[chain].pull = 0;
    go(20);
  }

  void expectSlips(int left, int right) {
    EXPECT_EQ(left, axes.slips(kLeftAxis));
    EXPECT_EQ(right, axes.slips(kRightAxis));
  }

  double mm_per_second[kAxisCount] = {6, -4, 0};
  LoadedMotors motors;

 private:
  const FlashTable table_;
  float room_[kSettingCount];
  settings::Values values_;
  int32_t at_[kAxisCount] = {0, 0, 0};

 public:
  Axes axes;
};

}  // namespace

TEST_F(Slips, AreBlamedOnTheChainThatLetGo) {
  go(kSettles);
  expectSlips(0, 0);
  letGo({kLeftAxis});
  expectSlips(1, 0);
  go(kSettles);
  letGo({kRightAxis});
  expectSlips(1, 1);
}

// A sled that is jerked, or a supply that sags, moves the duty of both.
TEST_F(Slips, AreNotSuspectedWhileTheOtherChainIsUnsteady) {
  go(kSettles);
  letGo({kLeftAxis, kRightAxis});
  expectSlips(0, 0);
  go(kSettles);
  letGo({kLeftAxis});
  expectSlips(1, 0);
}

TEST_F(Slips, AreNotSuspectedOfAChainThatHardlyMoves) {
  mm_per_second[kLeftAxis] = 0.79;
  go(kSettles);
  letGo({kLeftAxis});
  expectSlips(0, 0);
  mm_per_second[kLeftAxis] = 0.81;
  go(kSettles);
  letGo({kLeftAxis});
  expectSlips(1, 0);
}

TEST_F(Slips, AreNotSuspectedWhileAnyAxisChangesItsSpeed) {
  for (int axis = 0; axis < kAxisCount; ++axis) {
    go(kSettles);
    mm_per_second[axis] += 1;
    go(5);
    letGo({kLeftAxis});
    expectSlips(0, 0);
    mm_per_second[axis] -= 1;
  }
  go(kSettles);
  letGo({kLeftAxis});
  expectSlips(1, 0);
}

TEST_F(Slips, AreNotSuspectedWhileAnAxisIsOff) {
  axes.release(kZAxis);
  go(kSettles);
  letGo({kLeftAxis});
  expectSlips(0, 0);
}

TEST_F(Slips, AreNotSuspectedWithSimulatedMotors) {
  axes.simulate(true);
  axes.driveOpen(kLeftAxis, -255);
  go(kSettles);
  axes.release(kLeftAxis);  // the mean of its duty still falls when the calm is over
  axes.follow();
  go(kSettles);
  expectSlips(0, 0);
}
