// The control tick with its ring of set-points, its loops and its watch, on motors with random
// tolerances.
#include <gtest/gtest.h>

#include "machine/planner.h"
#include "settings_flash.h"
#include "world/motor.h"

using namespace machine;

namespace {

struct StillClock : Clock {
  uint32_t milliseconds() override { return 0; }
  void idle() override {}
  void holdTicks() override {}
  void releaseTicks() override {}
};

/// Motors of the forty behind the drives.
class MotorDrives : public Drives {
 public:
  explicit MotorDrives(unsigned seed) {
    for (unsigned i = 0; i < kAxisCount; ++i) motors.emplace_back(world::anyMotor(seed + i), i);
  }
  void drive(Axis axis, int16_t duty) override { duty_[axis] = duty; }
  void release(Axis axis) override { duty_[axis] = 0; }
  void brake(Axis axis) override { duty_[axis] = 0; }
  uint16_t count(Axis axis) override { return uint16_t(motors[axis].counts()); }
  uint16_t illegalSteps(Axis) override { return 0; }
  void arrange(bool, uint8_t) override {}

  void pass(double seconds) {
    // Positive drive winds in.
    for (unsigned i = 0; i < kAxisCount; ++i) motors[i].run(-duty_[i], seconds);
  }

  std::vector<world::Motor> motors;

 private:
  int duty_[kAxisCount] = {0, 0, 0};
};

/// The left axis in motion, with the machine's settings.
class Bench {
 public:
  Bench(unsigned seed, float ticks) : drives(seed), values_(table_, room_), axes(drives, clock_) {
    axes.setTicksPerSecond(ticks);
    axes.prepare(values_);
    planner_.prepare(values_, axes.secondsPerTick());
    planner_.standAt(axes.setPoint());
    axes.follow();
  }

  void travel(float length, float feed) { planner_.addAxis(kLeftAxis, length, feed / 60); }

  void tick() {
    ASSERT_TRUE(planner_.fill(axes, geometry_));
    axes.tick();
    drives.pass(double(axes.secondsPerTick()));
  }

  bool isMoving() const { return !planner_.isIdle() || !axes.isEmpty(); }
  double chain() const { return drives.motors[kLeftAxis].turns() * 63.5; }

  MotorDrives drives;

 private:
  StillClock clock_;
  FlashTable table_;
  float room_[kSettingCount];
  settings::Values values_;
  Planner planner_;
  Geometry geometry_;

 public:
  Axes axes;
};

}  // namespace

TEST(Axes, YieldToAWeakSupplyAndRecover) {
  for (const float ticks : {100.0f, 200.0f}) {
    for (unsigned seed = 0; seed < 20; ++seed) {
      Bench bench(seed, ticks);
      bench.travel(300, 900);
      double worst = 0, weak = 0, strong = 0;
      for (int tick = 0; bench.isMoving() && tick < int(60 * ticks); ++tick) {
        const double seconds = tick / double(ticks), before = bench.chain();
        bench.drives.motors[kLeftAxis].weaker = seconds > 3 && seconds < 12 ? 5.5 : 0;
        bench.tick();
        worst = std::max(worst, std::fabs(double(bench.axes.error(kLeftAxis))));
        const double speed = (bench.chain() - before) * double(ticks);
        if (seconds > 8 && seconds < 12) weak = std::max(weak, speed);
        if (seconds > 16 && seconds < 18) strong = std::max(strong, speed);
      }
      EXPECT_EQ(motion::Fault::kNone, bench.axes.fault().fault) << "motor " << seed;
      EXPECT_LT(worst, 1.95) << "motor " << seed;
      EXPECT_LT(weak, 13) << "motor " << seed;
      EXPECT_GT(strong, 14.5) << "motor " << seed;
      EXPECT_TRUE(bench.axes.hasYielded());
      for (int rest = 0; rest < int(ticks); ++rest) bench.tick();
      EXPECT_NEAR(300, bench.chain(), 0.05) << "motor " << seed;
    }
  }
}
