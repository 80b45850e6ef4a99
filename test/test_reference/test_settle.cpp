// From lengths back to the place, and what happens where no sled can hang or no root is.
#include <gtest/gtest.h>

#include <limits>

#include "machines.h"
#include "reference/newton.h"

using Eigen::Vector2d;
using reference::Machine;

namespace {

TEST(Settle, FindsTheBitOnAnyMachineFromAnyStart) {
  Lottery lottery;
  for (int i = 0; i < 1000; ++i) {
    const bool plane = i % 2 == 0;
    const Machine machine = plane ? lottery.drawMachine() : lottery.drawFullMachine();
    const Vector2d bit = lottery.drawPlace(), start = lottery.drawPlace();
    const reference::Hang hang = reference::hangAt(machine, bit);
    ASSERT_TRUE(hang.solved) << i;
    const reference::Hang settled = reference::settle(machine, hang.paid_out, start);
    ASSERT_TRUE(settled.solved) << i;
    EXPECT_LT((settled.bit - bit).norm(), 1e-8) << i;
  }
}

TEST(Settle, RefusesChainsThatDoNotMeet) {
  // Elastic chains could be stretched until they meet; a real chain tears at a few thousand
  // newtons.
  for (const Machine& machine : {Machine(), defaultMachine()}) {
    EXPECT_FALSE(reference::settle(machine, {1000, 1000}).solved);
    EXPECT_FALSE(reference::settle(machine, {100, 2500}).solved);
    EXPECT_FALSE(reference::settle(machine, {-50, 2000}).solved);
  }
}

TEST(Settle, RefusesNaN) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const Machine machine = defaultMachine();
  EXPECT_FALSE(reference::settle(machine, {none, 1700}).solved);
  EXPECT_FALSE(reference::settle(machine, {1700, 1700}, {none, 0}).solved);
  EXPECT_FALSE(reference::hangAt(machine, {0, none}).solved);
}

TEST(Hang, RefusesPlacesWhereNothingCanHang) {
  const Machine machine = defaultMachine();
  const double height = machine.motor_height;
  EXPECT_FALSE(reference::hangAt(machine, {0, height}).solved);
  EXPECT_FALSE(reference::hangAt(machine, {0, height + 200}).solved);
  EXPECT_FALSE(reference::hangAt(machine, {2000, 0}).solved);
  EXPECT_FALSE(reference::hangAt(machine, {-machine.motor_gap / 2 + 50, height - 40}).solved);
}

TEST(Hang, RefusesAChainThatLeansOutwards) {
  Machine machine = defaultMachine();
  machine.push = {200, 0};
  EXPECT_TRUE(reference::hangAt(machine, {1400, 0}).solved);
  EXPECT_FALSE(reference::hangAt(machine, {1800, 0}).solved);
}

TEST(Hang, RefusesAWeightlessSled) {
  Machine machine = defaultMachine();
  machine.sled_weight = 0;
  EXPECT_FALSE(reference::hangAt(machine, {0, 0}).solved);
}

using Vector = Eigen::Vector2d;

TEST(Newton, HalvesAStepThatOvershoots) {
  // From 3, whole steps on an arc tangent grow without end.
  const auto defect = [](const Vector& at) -> Vector { return {std::atan(at[0]), at[1] - at[0]}; };
  const reference::Root<2> root = reference::findRoot<2>(defect, Vector(3, 1));
  ASSERT_TRUE(root.found);
  EXPECT_NEAR(0, root.at[0], 1e-12);
  EXPECT_NEAR(0, root.at[1], 1e-12);
}

TEST(Newton, ReportsAMissingRoot) {
  const auto defect = [](const Vector& at) -> Vector { return {at[0] * at[0] + 1, at[1]}; };
  EXPECT_FALSE(reference::findRoot<2>(defect, Vector(3, 1)).found);
}

TEST(Newton, DoesNotTakeNaNForARoot) {
  const auto defect = [](const Vector& at) -> Vector { return {std::sqrt(at[0]), at[1]}; };
  EXPECT_FALSE(reference::findRoot<2>(defect, Vector(-1, 0)).found);
}

}  // namespace
