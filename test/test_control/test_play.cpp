// The play of a gear does not change how fast a motor winds in a chain that hardly pulls.
#include <gtest/gtest.h>

#include "world/motor.h"

namespace {

/// [rad/s] Speed at which a motor winds in for a while, by its turns.
double speedAt(const world::MotorConstants& constants, int duty) {
  world::Motor motor(constants, 1);
  for (int ms = 0; ms < 1000; ++ms) motor.run(-duty, 0.001);
  const double before = motor.turns();
  for (int ms = 0; ms < 1000; ++ms) motor.run(-duty, 0.001);
  return (before - motor.turns()) * world::kTurn;
}

TEST(Play, MotorInContactFeelsAllFrictionAndTheLoad) {
  world::MotorConstants c;
  c.supply_resistance = 0;
  for (const double load : {0.02, 0.1, 0.19, 0.21}) {
    c.load = load;
    const int duty = 131;
    const double volts = c.supply * duty / 255 - c.bridge_drop;
    const double torque = c.torque_constant * volts / c.resistance - c.coulomb - load;
    const double drag = c.torque_constant * c.torque_constant / c.resistance + c.viscous;
    EXPECT_NEAR(torque / drag, speedAt(c, duty), 0.002) << load;
  }
}

}  // namespace
