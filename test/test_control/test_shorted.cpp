// The simulated motor with its winding shorted, as a bridge does it to brake.
#include <gtest/gtest.h>

#include "world/motor.h"

using world::Motor;

namespace {

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
