// The judge against plane geometry, the differential equation, the textbook and published figures;
// forces add up to zero; from lengths back to the place, and where no root is.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "machines.h"
#include "reference/catenary.h"
#include "reference/newton.h"

using Eigen::Vector2d;
using Eigen::Vector3d;
using reference::Hand;
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

/// Follows a chain from `start` [mm], where its tension is `tension` [N], by Runge-Kutta.
Vector3d followChain(const Vector3d& start, const Vector3d& tension, const Vector3d& weight,
                     double length, double compliance) {
  const auto slope = [&](double s) -> Vector3d {
    const Vector3d here = tension - weight * s;
    return here / here.norm() + compliance * here;
  };
  const int kSteps = 400;
  const double step = length / kSteps;
  Vector3d place = start;
  for (int i = 0; i < kSteps; ++i) {
    const double s = i * step;
    place += step / 6 * (slope(s) + 4 * slope(s + step / 2) + slope(s + step));
  }
  return place;
}

/// Distance [mm] from the ring at the end of the left chain, followed from its sprocket.
double missOfLeft(const Machine& machine, const reference::Hang& hang) {
  const double a = hang.left.departure_angle, t = hang.left.tension_at_sprocket;
  const Vector3d weight =
      machine.left.weight * Vector3d(0, -std::cos(machine.lean), -std::sin(machine.lean));
  Vector3d tension(std::cos(a), -std::sin(a), 0);
  const double off_sheet = hang.left.pull.z() - weight.z() * hang.left.free_length;
  tension *= std::sqrt(t * t - off_sheet * off_sheet);
  tension.z() = -off_sheet;
  const Vector3d reached = followChain(hang.left.leaves, tension, weight, hang.left.free_length,
                                       machine.left.compliance);
  const Vector2d arm = machine.rotation_radius * hang.left.pull.head<2>().normalized();
  return (reached - Vector3d(hang.bit.x() + arm.x(), hang.bit.y() + arm.y(), 0)).norm();
}

TEST(Catenary, FromTheSprocketEndsOnTheRing) {
  Lottery lottery;
  for (int i = 0; i < 200; ++i) {
    const Machine machine = lottery.drawFullMachine();
    const reference::Hang hang = reference::hangAt(machine, lottery.drawPlace());
    ASSERT_TRUE(hang.solved) << i;
    EXPECT_LT(missOfLeft(machine, hang), 1e-8) << i;
  }
}

TEST(Catenary, AgreesWithTheTextbook) {
  const double h = 19, top = 11, weight = 0.0014, length = 2600, compliance = 5e-6;
  const double bottom = top - weight * length;
  const double x =
      h / weight * (std::asinh(top / h) - std::asinh(bottom / h)) + compliance * h * length;
  const double y = (std::hypot(h, top) - std::hypot(h, bottom)) / weight +
                   compliance * length * (top + bottom) / 2;
  const Vector3d span = reference::spanOf({h, -top, 0}, {h, -bottom, 0}, length, compliance);
  EXPECT_NEAR(x, span.x(), 1e-9);
  EXPECT_NEAR(-y, span.y(), 1e-9);
}

TEST(Catenary, SeriesAndFunctionMeet) {
  const double below = reference::atanhExcess(0.1), above = reference::atanhExcess(0.1 + 1e-12);
  EXPECT_NEAR(below, above, 1e-12);
  EXPECT_DOUBLE_EQ(1.0 / 3, reference::atanhExcess(0));
  EXPECT_NEAR((std::atanh(0.3) / 0.3 - 1) / 0.09, reference::atanhExcess(0.09), 1e-13);
}

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

TEST(Anchors, LengthsBeyondStraightLinesSpanThePublishedRange) {
  double least = 1e9, most = -1e9, slackest = 1e9, tightest = 0;
  for (const Vector2d& bit : gridOver(49, 25)) {
    const reference::Hang hang = reference::hangAt(defaultMachine(), bit);
    const Vector2d beyond = hang.paid_out - lengthsOf(Machine(), bit);
    least = std::min(least, beyond.minCoeff());
    most = std::max(most, beyond.maxCoeff());
    for (const reference::ChainForm* form : {&hang.left, &hang.right}) {
      slackest = std::min(slackest, form->tension_at_sprocket);
      tightest = std::max(tightest, form->tension_at_sprocket);
    }
  }
  // That solver also stretched the chain on the teeth, by up to 0.008 mm.
  EXPECT_NEAR(-1.38, least, 0.013);
  EXPECT_NEAR(6.18, most, 0.013);
  EXPECT_NEAR(18.0, slackest, 0.06);
  EXPECT_NEAR(165.2, tightest, 0.1);
}

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
