// A chain from sprocket to sprocket against its differential equation, the ruler and the parabola.
#include <gtest/gtest.h>

#include "machines.h"
#include "reference/across.h"
#include "reference/sprocket.h"

using Eigen::Vector3d;
using reference::Across;
using reference::Hand;
using reference::Machine;

namespace {

const double kBeyond = 12.7;

Machine frame() {
  Machine machine;
  machine.left.weight = machine.right.weight = 0.00137;
  machine.left.compliance = machine.right.compliance = 5.17e-6;
  return machine;
}

Across leftAcross(const Machine& machine, double more_than_gap) {
  return reference::stretchAcross(machine, Hand::kLeft, machine.motor_gap + kBeyond + more_than_gap,
                                  kBeyond);
}

/// The place that a chain reaches, link by link, from where it leaves the left sprocket.
Vector3d followed(const Machine& machine, const Across& across, double length) {
  const int kSteps = 20000;
  const double step = length / kSteps;
  const Vector3d weight = machine.left.weight * reference::downOf(machine);
  Vector3d place = reference::axisAtRest(machine, Hand::kLeft) +
                   reference::mountGive(machine.left, across.pull) +
                   reference::departAlong(machine, Hand::kLeft, across.pull).point;
  for (int i = 0; i < kSteps; ++i) {
    const Vector3d here = across.pull - weight * ((i + 0.5) * step);
    place += step * (here / here.norm() + machine.left.compliance * here);
  }
  return place;
}

TEST(Across, FollowedLinkByLinkReachesTheOtherSprocket) {
  Machine machine = frame();
  machine.left.inward = machine.right.inward = 0.01;
  machine.height_difference = 7;
  for (const double more : {40.0, 3.0, 0.0, -2.0}) {
    const Across across = leftAcross(machine, more);
    ASSERT_TRUE(across.solved) << more;
    const double wraps = reference::departAlong(machine, Hand::kLeft, across.pull).wrap +
                         reference::departAlong(machine, Hand::kRight, across.other_pull).wrap;
    const Vector3d held = reference::axisAtRest(machine, Hand::kRight) +
                          reference::mountGive(machine.right, across.other_pull) +
                          reference::departAlong(machine, Hand::kRight, across.other_pull).point;
    const Vector3d reached = followed(machine, across, machine.motor_gap + more - wraps);
    EXPECT_LT((reached - held).norm(), 1e-6) << more;
  }
}

TEST(Across, OnTheRightIsTheMirrorImage) {
  Machine machine = frame();
  machine.left.pitch = machine.right.pitch = 0.001;
  const Across left = leftAcross(machine, 2);
  const Across right =
      reference::stretchAcross(machine, Hand::kRight, machine.motor_gap + kBeyond + 2, kBeyond);
  ASSERT_TRUE(left.solved && right.solved);
  EXPECT_NEAR(left.pull.x(), -right.pull.x(), 1e-9);
  EXPECT_NEAR(left.pull.y(), right.pull.y(), 1e-9);
  // Long links make the chain slacker.
  EXPECT_LT(left.pull.x(), leftAcross(frame(), 2).pull.x());
}

TEST(Across, OfASlackWeightlessChainHasNoTension) {
  Machine machine = frame();
  machine.left.weight = 0;
  EXPECT_FALSE(leftAcross(machine, 5).solved);
}

TEST(Across, IsFoundFarFromTheStartOfTheSearch) {
  const Machine machine = frame();
  for (const double more : {-12.0, -5.0, 0.1, 60.0, 300.0}) {
    const Across across = leftAcross(machine, more);
    ASSERT_TRUE(across.solved) << more;
    const Across again = reference::stretchAcross(
        machine, Hand::kLeft, machine.motor_gap + kBeyond + more, kBeyond, leftAcross(machine, 1));
    ASSERT_TRUE(again.solved) << more;
    EXPECT_LT((across.pull - again.pull).norm(), 1e-6) << more;
  }
}

}  // namespace
