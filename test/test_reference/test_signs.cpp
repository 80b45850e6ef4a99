// Which way each property of a chain changes the length that must be paid out.
#include <gtest/gtest.h>

#include "machines.h"

using Eigen::Vector2d;
using reference::Machine;

namespace {

TEST(Signs, LongLinksReduceOnlyTheFreeChain) {
  Machine machine;
  machine.left.pitch = 0.002;
  for (const Vector2d& bit : gridOver(7, 5)) {
    const reference::Hang plain = reference::hangAt(Machine(), bit);
    const Vector2d paid_out = lengthsOf(machine, bit);
    EXPECT_NEAR(plain.left.wrap + plain.left.free_length / 1.002, paid_out[0], 1e-9);
    EXPECT_NEAR(plain.paid_out[1], paid_out[1], 1e-9);
  }
}

TEST(Signs, ChainThatIsOutAtZeroIsNotCounted) {
  Machine machine = defaultMachine();
  machine.right.zero = 6.35;
  const Vector2d bit(300, -100);
  const Vector2d change = lengthsOf(machine, bit) - lengthsOf(defaultMachine(), bit);
  EXPECT_NEAR(0, change[0], 1e-9);
  EXPECT_NEAR(-6.35, change[1], 1e-9);
}

TEST(Signs, MirroredMachineHangsMirrored) {
  Lottery lottery;
  for (int i = 0; i < 100; ++i) {
    Machine machine = lottery.drawFullMachine();
    const Vector2d bit = lottery.drawPlace();
    const Vector2d there = lengthsOf(machine, bit);
    std::swap(machine.left, machine.right);
    machine.motor_center_x = -machine.motor_center_x;
    machine.height_difference = -machine.height_difference;
    machine.push.x() = -machine.push.x();
    for (reference::ChainSide* side : {&machine.left, &machine.right})
      side->eccentricity.x() = -side->eccentricity.x();
    const Vector2d mirrored = lengthsOf(machine, {-bit.x(), bit.y()});
    EXPECT_NEAR(there[0], mirrored[1], 1e-8);
    EXPECT_NEAR(there[1], mirrored[0], 1e-8);
  }
}

}  // namespace
