// The chain's closed form against its differential equation and against the textbook.
#include <gtest/gtest.h>

#include "machines.h"
#include "reference/catenary.h"

using Eigen::Vector2d;
using Eigen::Vector3d;
using reference::Machine;

namespace {

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

}  // namespace
