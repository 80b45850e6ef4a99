// The sled with two brackets: balance, symmetry, and the lowest place its chains allow.
#include <gtest/gtest.h>

#include "machines.h"
#include "reference/newton.h"
#include "reference/two_brackets.h"

using Eigen::Vector2d;
using reference::Hand;
using reference::Machine;
using reference::TiltedHang;
using reference::TwoBrackets;

namespace {

double cross(const Vector2d& first, const Vector2d& second) {
  return first.x() * second.y() - first.y() * second.x();
}

TwoBrackets drawSled(Lottery& lottery) {
  return {lottery.between(240, 340), lottery.between(100, 180), lottery.between(30, 150)};
}

/// Straight machines, on which a bracketed sled can hang all over the sheet.
Machine drawStraight(Lottery& lottery) {
  Machine machine;
  machine.motor_gap = lottery.between(2900, 3700);
  machine.motor_height = 609.6 + lottery.between(350, 900);
  machine.over_top = lottery.chance(0.5);
  return machine;
}

/// [mm] From 12 o'clock along a line that touches the sprocket to a bracket, by plane geometry.
double tightLength(const Machine& machine, Hand hand, const Vector2d& bracket) {
  const Vector2d away = bracket - reference::axisAtRest(machine, hand).head<2>();
  const double run = reference::inwardSign(hand) * away.x(), radius = machine.sprocket_radius;
  const double slope = std::atan2(-away.y(), run), lift = std::asin(radius / away.norm());
  const double angle = machine.over_top ? slope + lift : M_PI - slope + lift;
  return std::sqrt(away.squaredNorm() - radius * radius) + radius * angle;
}

/// The bit of a sled forced to some tilt on taut chains.
Vector2d bitAtTilt(const Machine& machine, const TwoBrackets& sled, double tilt,
                   const TiltedHang& near) {
  const auto defect = [&](const Vector2d& bit) -> Vector2d {
    Vector2d miss;
    for (Hand hand : {Hand::kLeft, Hand::kRight}) {
      const int side = hand == Hand::kLeft ? 0 : 1;
      const Vector2d bracket =
          bit * machine.motor_gap + reference::bracketFromBit(sled, hand, tilt);
      miss[side] = (tightLength(machine, hand, bracket) - near.paid_out[side]) / machine.motor_gap;
    }
    return miss;
  };
  const reference::Root<2> root = reference::findRoot<2>(defect, near.bit / machine.motor_gap);
  EXPECT_TRUE(root.found);
  return root.at * machine.motor_gap;
}

/// [mm] Height of the centre of gravity then: the energy per weight.
double heightAtTilt(const Machine& machine, const TwoBrackets& sled, double tilt,
                    const TiltedHang& near) {
  return (bitAtTilt(machine, sled, tilt, near) + reference::centerFromBit(sled, tilt)).y();
}

}  // namespace

TEST(TwoBrackets, ForcesAndMomentsVanishOnAnyMachine) {
  Lottery lottery;
  for (int i = 0; i < 300; ++i) {
    const Machine machine = withChains(drawStraight(lottery), 0.00137293, 5.17e-6);
    const TwoBrackets sled = drawSled(lottery);
    const TiltedHang hang = reference::hangTilted(machine, sled, lottery.drawPlace());
    ASSERT_TRUE(hang.solved);
    const Vector2d weight(0, -machine.sled_weight);
    const Vector2d left = hang.left.pull.head<2>(), right = hang.right.pull.head<2>();
    EXPECT_LT((left + right + weight).norm(), 1e-8);
    // About the sheet's middle, with the brackets where the chains end.
    const Vector2d center = hang.bit + reference::centerFromBit(sled, hang.tilt);
    EXPECT_NEAR(0,
                cross(hang.left.ends.head<2>(), left) + cross(hang.right.ends.head<2>(), right) +
                    cross(center, weight),
                1e-5);
    EXPECT_NEAR(sled.mount_gap, (hang.left.ends - hang.right.ends).norm(), 1e-8);
  }
}

TEST(TwoBrackets, ChainsAreTangentsAsDrawnWithRulerAndCompass) {
  Lottery lottery;
  for (int i = 0; i < 100; ++i) {
    const Machine machine = drawStraight(lottery);
    const TwoBrackets sled = drawSled(lottery);
    const TiltedHang hang = reference::hangTilted(machine, sled, lottery.drawPlace());
    ASSERT_TRUE(hang.solved);
    for (Hand hand : {Hand::kLeft, Hand::kRight}) {
      const Vector2d bracket = hang.bit + reference::bracketFromBit(sled, hand, hang.tilt);
      EXPECT_NEAR(tightLength(machine, hand, bracket), hang.paid_out[hand == Hand::kLeft ? 0 : 1],
                  1e-8);
    }
  }
}

TEST(TwoBrackets, NoOtherTiltOnTheSameChainsIsLower) {
  Lottery lottery;
  for (int i = 0; i < 60; ++i) {
    const Machine machine = drawStraight(lottery);
    const TwoBrackets sled = drawSled(lottery);
    const TiltedHang hang = reference::hangTilted(machine, sled, lottery.drawPlace());
    ASSERT_TRUE(hang.solved);
    const auto height = [&](double turn) {
      return heightAtTilt(machine, sled, hang.tilt + turn, hang);
    };
    const double rest = height(0);
    for (double turn : {0.003, 0.03, 0.1, 0.2}) {
      EXPECT_GT(height(turn), rest + 50 * turn * turn) << "tilt " << hang.tilt;
      EXPECT_GT(height(-turn), rest + 50 * turn * turn) << "tilt " << hang.tilt;
    }
    EXPECT_NEAR(0, (height(1e-4) - height(-1e-4)) / 2e-4, 1e-4) << "tilt " << hang.tilt;
  }
}

TEST(TwoBrackets, HangLikeAPendulumWhenBothAreInOnePlace) {
  // There is no tilt then, and the chains are those of a sled without a ring at the bracket's
  // height.
  Machine machine = defaultMachine();
  machine.rotation_radius = 0;
  const TwoBrackets sled = {0, 139, 79};
  for (const Vector2d& bit : gridOver(5, 5)) {
    const TiltedHang hang = reference::hangTilted(machine, sled, bit);
    const reference::Hang known = reference::hangAt(machine, bit + Vector2d(0, 139));
    ASSERT_TRUE(hang.solved && known.solved);
    EXPECT_NEAR(0, hang.tilt, 1e-9);
    EXPECT_LT((hang.paid_out - known.paid_out).norm(), 1e-7);
  }
}

TEST(TwoBrackets, ReportsThatNoSledCanHang) {
  EXPECT_FALSE(reference::hangTilted(Machine(), {}, {0, 1100}).solved);
  EXPECT_FALSE(reference::hangTilted(Machine(), {}, {1600, 0}).solved);
}
