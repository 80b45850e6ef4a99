// The simulated motor: the play of its gear, and its winding shorted, as a bridge does it to brake.
#include <gtest/gtest.h>

#include "world/motor.h"

using world::Motor;

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

/// [rad] How far a motor runs on from full speed, after `change`.
template <class Change>
double ranOn(Change change, int duty = 255) {
  Motor motor(world::MotorConstants(), 1);
  motor.run(duty, 1);
  motor.is_powered = false;
  change(motor);
  const double begin = motor.turns();
  motor.run(0, 3);
  const double stood = motor.turns();
  motor.run(0, 1);
  EXPECT_EQ(stood, motor.turns()) << "it has to stand at the end";
  return std::fabs(stood - begin) * world::kTurn;
}

void shorten(Motor& motor) { motor.is_shorted = true; }

}  // namespace

TEST(ShortedMotor, StopsSooner) {
  for (const int duty : {255, -255}) {
    const double runs = ranOn([](Motor&) {}, duty);
    EXPECT_LT(ranOn(shorten, duty), 0.6 * runs) << duty;
  }
}

TEST(ShortedMotor, CoastsWhenNoCurrentCanFlow) {
  const double runs = ranOn([](Motor&) {});
  const auto runsAs = [&](void (*change)(Motor&)) {
    return ranOn([&](Motor& motor) {
             shorten(motor);
             change(motor);
           }) == runs;
  };
  EXPECT_FALSE(runsAs([](Motor&) {}));
  EXPECT_TRUE(runsAs([](Motor& motor) { motor.weaker = 10.3; })) << "the bridge has no supply";
  EXPECT_TRUE(runsAs([](Motor& motor) { motor.wires.motor_unplugged = true; }));
  EXPECT_TRUE(runsAs([](Motor& motor) { motor.wires.driver_complains = true; }));
}

TEST(ShortedMotor, IsNotBrakedBelowTheBridgesVoltageDrop) {
  // 80 of 255 overcome friction and drop; the motor turns with less back-EMF than 1.8 V.
  Motor motor(world::MotorConstants(), 1);
  motor.run(80, 2);
  const double before = motor.turns();
  motor.run(80, 0.1);
  const double speed = (motor.turns() - before) * world::kTurn / 0.1;
  EXPECT_GT(speed, 0.2);
  EXPECT_LT(speed * world::MotorConstants().torque_constant, 1.8);
  EXPECT_EQ(ranOn([](Motor&) {}, 80), ranOn(shorten, 80));
}
