// Mounts that move: under load, with the turning sprocket, and out of the sheet's plane.
#include <gtest/gtest.h>

#include "machines.h"

using Eigen::Vector2d;
using Eigen::Vector3d;
using reference::Hand;
using reference::Machine;

namespace {

const double kQuarterTurn = 63.5 / 4;  // [mm]

TEST(Mounts, GivingWayEqualsStandingElsewhere) {
  Machine giving = defaultMachine();
  giving.left.inward = giving.right.inward = 0.01;
  giving.left.downward = giving.right.downward = 0.03;
  const Vector2d bit(0, -150);  // both motors give alike
  const reference::Hang hang = reference::hangAt(giving, bit);
  ASSERT_TRUE(hang.solved);
  const double a = hang.left.departure_angle, t = hang.left.tension_at_sprocket;
  Machine elsewhere = defaultMachine();
  elsewhere.motor_gap -= 2 * 0.01 * t * std::cos(a);
  elsewhere.motor_height -= 0.03 * t * std::sin(a);
  const Vector2d expected = reference::hangAt(elsewhere, bit).paid_out;
  EXPECT_LT((expected - hang.paid_out).norm(), 1e-9);
  EXPECT_GT((reference::hangAt(defaultMachine(), bit).paid_out - hang.paid_out).norm(), 0.5);
}

TEST(Mounts, SprocketTurnsWithItsChain) {
  Machine machine;
  machine.left.eccentricity = machine.right.eccentricity = {0.1, 0};
  const auto after = [&](Hand hand) -> Vector3d {
    return reference::eccentricityAfter(machine, hand, kQuarterTurn);
  };
  // Chain that runs to the right over the top turns the left sprocket like a clock.
  EXPECT_LT((after(Hand::kLeft) - Vector3d(0, -0.1, 0)).norm(), 1e-12);
  EXPECT_LT((after(Hand::kRight) - Vector3d(0, 0.1, 0)).norm(), 1e-12);
  machine.over_top = false;
  EXPECT_LT((after(Hand::kLeft) - Vector3d(0, 0.1, 0)).norm(), 1e-12);
  EXPECT_LT((after(Hand::kRight) - Vector3d(0, -0.1, 0)).norm(), 1e-12);
}

TEST(Mounts, EccentricSprocketIsFeltAsAWaveOfOneTurn) {
  Machine round, eccentric;
  eccentric.left.eccentricity = {0.1, 0};
  double most = 0;
  for (int x = 0; x < 64; ++x) {
    const Vector2d bit(x, 0);
    const reference::Hang plain = reference::hangAt(round, bit);
    const double a = plain.left.departure_angle;
    const double turn = plain.paid_out[0] / round.sprocket_radius;
    // The axis moves by the eccentricity turned clockwise; along the chain it saves this much.
    const double saved = 0.1 * std::cos(turn) * std::cos(a) + 0.1 * std::sin(turn) * std::sin(a);
    const double felt = reference::hangAt(eccentric, bit).paid_out[0] - plain.paid_out[0];
    EXPECT_NEAR(-saved, felt, 2e-3);
    most = std::max(most, std::abs(felt));
  }
  EXPECT_NEAR(0.1, most, 2e-3);
}

TEST(Mounts, StraightChainOffTheSheetIsAHypotenuse) {
  Machine machine;
  machine.plane_gap = 40;
  for (const Vector2d& bit : gridOver(9, 5)) {
    const reference::Hang flat = reference::hangAt(Machine(), bit);
    const reference::Hang hang = reference::hangAt(machine, bit);
    ASSERT_TRUE(hang.solved);
    EXPECT_NEAR(std::hypot(flat.left.free_length, 40), hang.left.free_length, 1e-9);
    EXPECT_NEAR(flat.left.wrap, hang.left.wrap, 1e-9);
  }
}

TEST(Mounts, HeightDifferenceRaisesOneMotorAndLowersTheOther) {
  Machine machine;
  machine.height_difference = 8;
  machine.motor_center_x = 3;
  const Vector2d bit(-200, 100);
  Machine left_as = Machine(), right_as = Machine();
  left_as.motor_height -= 4;
  right_as.motor_height += 4;
  const Vector2d shifted(bit.x() - 3, bit.y());
  const Vector2d lengths = reference::hangAt(machine, bit).paid_out;
  EXPECT_NEAR(reference::hangAt(left_as, shifted).paid_out[0], lengths[0], 1e-9);
  EXPECT_NEAR(reference::hangAt(right_as, shifted).paid_out[1], lengths[1], 1e-9);
}

}  // namespace
