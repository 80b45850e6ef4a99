// The control tick with its ring of set-points, its loops and its watch, on motors that are weak
// for a while or whose chain lets go for a moment.
#include <gtest/gtest.h>

#include <vector>

#include "../test_machine/board_at_rest.h"
#include "machine/axes.h"
#include "machine/planner.h"
#include "settings_flash.h"
#include "world/motor.h"

using namespace machine;

namespace {

/// A board with a motor for each axis.
struct MotorBoard : BoardAtRest {
  uint16_t count(Axis axis) override { return uint16_t(motors[axis].counts()); }
  void pass(double seconds) {
    // A positive drive winds in.
    for (unsigned i = 0; i < kAxisCount; ++i) motors[i].run(-duty[i], seconds);
  }

  std::vector<world::Motor> motors;
};

/// The left axis in motion, with the machine's settings.
class Bench {
 public:
  Bench(unsigned seed, float ticks) : values_(table_, room_), axes(board, board) {
    for (unsigned i = 0; i < kAxisCount; ++i)
      board.motors.emplace_back(world::anyMotor(seed + i), i);
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
    board.pass(double(axes.secondsPerTick()));
  }

  bool isMoving() const { return !planner_.isIdle() || !axes.isEmpty(); }
  double chain() const { return board.motors[kLeftAxis].turns() * 63.5; }

  MotorBoard board;

 private:
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
        bench.board.motors[kLeftAxis].weaker = seconds > 3 && seconds < 12 ? 5.5 : 0;
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

namespace {

const double kSlipTick = 0.01;  // [s]
const int kSettles = 200;  // [ticks] until the watch looks: two means and a calm of half a second

const double kLoad = 0.96;  // [Nm] 95 N of chain at an arm of 10.1 mm

/// Axes that go evenly, each at its speed. Their motors hold a sled in the middle of the sheet.
struct Slips : testing::Test, MotorBoard {
  Slips() : values_(table_, room_), axes(*this, *this) {
    world::MotorConstants constants;
    constants.load = kLoad;
    constants.count_noise = 0;  // so that each tug of the duty has a cause
    for (unsigned i = 0; i < kAxisCount; ++i) motors.emplace_back(constants, i + 1);
    values_.setRow(kZPositionP, 1300);
    axes.prepare(values_);
    axes.follow();
  }

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
      pass(kSlipTick);
    }
  }

  /// The chains let go of their motors for 30 ms, and what follows of it is over.
  void letGo(std::initializer_list<Axis> chains) {
    for (const Axis chain : chains) motors[chain].pull = -kLoad;
    go(3);
    for (const Axis chain : chains) motors[chain].pull = 0;
    go(20);
  }

  void expectSlips(int left, int right) {
    EXPECT_EQ(left, axes.slips(kLeftAxis));
    EXPECT_EQ(right, axes.slips(kRightAxis));
  }

  double mm_per_second[kAxisCount] = {6, -4, 0};

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
