// No control tick interrupts the main program while it reads or writes shared numbers of the axes.
#include <gtest/gtest.h>

#include <functional>
#include <utility>
#include <vector>

#include "machine/axes.h"
#include "settings_flash.h"

using namespace machine;

namespace {

/// Counts how often ticks were kept off, and knows whether they still are.
struct Gate : Clock {
  uint32_t milliseconds() override { return 0; }
  void idle() override {}
  void holdTicks() override {
    ++depth;
    ++times;
  }
  void releaseTicks() override { --depth; }
  int depth = 0, times = 0;
};

/// Motors that require ticks to be kept off while they are read or released.
struct GuardedMotors : Drives {
  explicit GuardedMotors(const Gate& gate) : gate(gate) {}
  void drive(Axis, int16_t) override {}
  void release(Axis) override { EXPECT_GT(gate.depth, 0); }
  void brake(Axis) override { EXPECT_GT(gate.depth, 0); }
  uint16_t count(Axis) override {
    EXPECT_GT(gate.depth, 0);
    return 0;
  }
  uint16_t illegalSteps(Axis) override { return 0; }
  void arrange(bool, uint8_t) override {}
  const Gate& gate;
};

}  // namespace

TEST(AxesGuards, SharedStateChangesOnlyWithTicksHeldOff) {
  const FlashTable table;
  float room[kSettingCount];
  settings::Values values(table, room);
  Gate gate;
  GuardedMotors motors(gate);
  Axes axes(motors, gate);
  const std::vector<std::pair<const char*, std::function<void()>>> calls = {
      {"prepare", [&] { axes.prepare(values); }},
      {"isEmpty", [&] { axes.isEmpty(); }},
      {"dropSetPoints", [&] { axes.dropSetPoints(); }},
      {"stand", [&] { axes.stand(); }},
      {"goOn", [&] { axes.goOn(); }},
      {"isPathAtRest", [&] { axes.isPathAtRest(); }},
      {"isAtRest", [&] { axes.isAtRest(); }},
      {"goAt", [&] { axes.goAt(128); }},
      {"lift", [&] { axes.lift(1, 1, 1); }},
      {"lower", [&] { axes.lower(1, 1); }},
      {"isLifted", [&] { axes.isLifted(); }},
      {"plannedZ", [&] { axes.plannedZ(); }},
      {"liftedTo", [&] { axes.liftedTo(); }},
      {"declareLifted", [&] { axes.declareLifted(1); }},
      {"setPoint", [&] { axes.setPoint(); }},
      {"standStill", [&] { axes.standStill(); }},
      {"jumpTo", [&] { axes.jumpTo(kLeftAxis, 1); }},
      {"follow", [&] { axes.follow(); }},
      {"release", [&] { axes.release(kLeftAxis); }},
      {"releaseAll", [&] { axes.releaseAll(); }},
      {"brakeAll", [&] { axes.brakeAll(); }},
      {"driveOpen", [&] { axes.driveOpen(kLeftAxis, 1); }},
      {"turn", [&] { axes.turn(kLeftAxis, 1); }},
      {"simulate", [&] { axes.simulate(true); }},
      {"counts", [&] { axes.counts(kLeftAxis); }},
      {"setCounts", [&] { axes.setCounts(1, 2, 3); }},
      {"length", [&] { axes.length(kLeftAxis); }},
      {"target", [&] { axes.target(kLeftAxis); }},
      {"mostBehind", [&] { axes.mostBehind(kLeftAxis); }},
      {"error", [&] { axes.error(kLeftAxis); }},
      {"declare", [&] { axes.declare(kLeftAxis, 1); }},
      {"state", [&] { axes.state(kLeftAxis); }},
      {"forgetRawCounts", [&] { axes.forgetRawCounts(); }},
      {"fault", [&] { axes.fault(); }},
  };
  for (const auto& [name, call] : calls) {
    gate.times = 0;
    call();
    EXPECT_GT(gate.times, 0) << name;
    EXPECT_EQ(0, gate.depth) << name;
  }
}
