// A sled at rest: forces add up to zero, and no pull turns the arm it acts on.
#include <gtest/gtest.h>

#include "machines.h"

using Eigen::Vector2d;
using Eigen::Vector3d;
using reference::Machine;

namespace {

TEST(Balance, PullsCarryTheSled) {
  for (bool over_top : {true, false}) {
    Machine machine = defaultMachine();
    machine.over_top = over_top;
    for (const Vector2d& bit : gridOver(13, 7, 10)) {
      const reference::Hang hang = reference::hangAt(machine, bit);
      ASSERT_TRUE(hang.solved);
      const Vector3d sum = hang.left.pull + hang.right.pull;
      EXPECT_NEAR(0, sum.x(), 1e-9);
      EXPECT_NEAR(97.9, sum.y(), 1e-9);
      EXPECT_LT(hang.left.pull.x(), 0);
      EXPECT_GT(hang.right.pull.x(), 0);
    }
  }
}

TEST(Balance, PullsPassThroughTheBit) {
  const Machine machine = defaultMachine();
  for (const Vector2d& bit : gridOver(13, 7)) {
    const reference::Hang hang = reference::hangAt(machine, bit);
    for (const reference::ChainForm* form : {&hang.left, &hang.right}) {
      const Vector2d arm = form->ends.head<2>() - bit;
      const double moment = arm.x() * form->pull.y() - arm.y() * form->pull.x();
      EXPECT_NEAR(0, moment, 1e-7);  // [N mm] of about 10,000
      EXPECT_NEAR(machine.rotation_radius, arm.norm(), 1e-9);
      EXPECT_GT(arm.dot(form->pull.head<2>()), 0);
    }
  }
}

TEST(Balance, ChainLeavesItsSprocketAlongTheTangent) {
  Machine machine = defaultMachine();
  for (bool over_top : {true, false}) {
    machine.over_top = over_top;
    for (const Vector2d& bit : gridOver(13, 7)) {
      const reference::Hang hang = reference::hangAt(machine, bit);
      const Vector2d center(-machine.motor_gap / 2, machine.motor_height);
      const Vector2d spoke = hang.left.leaves.head<2>() - center;
      const double a = hang.left.departure_angle;
      EXPECT_NEAR(machine.sprocket_radius, spoke.norm(), 1e-9);
      EXPECT_NEAR(0, spoke.dot(Vector2d(std::cos(a), -std::sin(a))), 1e-9);
      EXPECT_EQ(over_top, spoke.y() > 0);
    }
  }
}

TEST(Balance, PushIsCarriedByTheChains) {
  Machine machine = defaultMachine();
  machine.push = {3, -2};
  const reference::Hang hang = reference::hangAt(machine, {400, -200});
  const Vector3d sum = hang.left.pull + hang.right.pull;
  EXPECT_NEAR(-3, sum.x(), 1e-9);
  EXPECT_NEAR(97.9 + 2, sum.y(), 1e-9);
}

TEST(Balance, LeaningSheetCarriesItsShare) {
  Machine machine = defaultMachine();
  machine.lean = 0.2618;
  const reference::Hang hang = reference::hangAt(machine, {400, -200});
  EXPECT_NEAR(97.9 * std::cos(0.2618), hang.left.pull.y() + hang.right.pull.y(), 1e-9);
}

}  // namespace
