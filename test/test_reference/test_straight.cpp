// Chains without weight are straight lines: the judge against plane geometry.
#include <gtest/gtest.h>

#include "machines.h"

using Eigen::Vector2d;
using reference::Machine;

namespace {

struct Line {
  double wrap, free;  // [mm] on the teeth; from there to the bit
};

/// The tangent from a point to a circle ends where the circle over their distance (Thales) cuts it.
Line drawTangent(const Vector2d& center, double radius, const Vector2d& bit, double sign,
                 bool over_top) {
  const Vector2d to_bit = bit - center;
  const double d = to_bit.norm();
  const double foot = radius * radius / d;  // along the line to the bit
  const double aside = std::sqrt(radius * radius - foot * foot);
  const Vector2d along = to_bit / d, across(-along.y(), along.x());
  const Vector2d first = foot * along + aside * across, second = foot * along - aside * across;
  const bool first_is_higher = first.y() > second.y();
  const Vector2d touch = first_is_higher == over_top ? first : second;
  // Clockwise from 12 o'clock for the left sprocket over the top, counterclockwise off the bottom.
  double angle = std::atan2(sign * touch.x(), touch.y());
  if (!over_top) angle = -angle;
  return {radius * angle, (to_bit - touch).norm()};
}

void expectStraight(const Machine& machine, const Vector2d& bit) {
  const reference::Hang hang = reference::hangAt(machine, bit);
  ASSERT_TRUE(hang.solved) << bit.transpose();
  for (int side : {0, 1}) {
    const double sign = side == 0 ? 1 : -1;
    const Vector2d center(-sign * machine.motor_gap / 2, machine.motor_height);
    const Line line = drawTangent(center, machine.sprocket_radius, bit, sign, machine.over_top);
    const reference::ChainForm& form = side == 0 ? hang.left : hang.right;
    const double compliance = side == 0 ? machine.left.compliance : machine.right.compliance;
    const double free =
        (line.free - machine.rotation_radius) / (1 + compliance * form.tension_at_ring);
    EXPECT_NEAR(line.wrap + free, hang.paid_out[side], 1e-9) << bit.transpose();
    EXPECT_NEAR(line.wrap, form.wrap, 1e-9) << bit.transpose();
  }
}

TEST(Straight, RigidChainIsTheTangentToItsSprocket) {
  for (bool over_top : {true, false}) {
    Machine machine;
    machine.over_top = over_top;
    for (const Vector2d& bit : gridOver(13, 7, 10)) expectStraight(machine, bit);
  }
}

TEST(Straight, StretchedChainIsItsTangentDividedByItsStretch) {
  Lottery lottery;
  for (int i = 0; i < 200; ++i) {
    const Machine drawn = lottery.drawMachine();
    Machine machine = withChains(drawn, 0, lottery.between(0, 2e-5));
    for (reference::ChainSide* side : {&machine.left, &machine.right}) side->pitch = side->zero = 0;
    expectStraight(machine, lottery.drawPlace());
  }
}

}  // namespace
