// Where a chain leaves its sprocket, and how much of it still lies on the teeth.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "reference/machine.h"

namespace reference {

/// The place where a chain leaves the teeth.
struct Departure {
  double angle;           ///< [rad] of the leaving chain below the horizontal
  double wrap;            ///< [mm] of chain on the teeth from 12 o'clock to here
  Eigen::Vector3d point;  ///< [mm] measured from the sprocket's own centre
};

/// A chain leaves where the circle's tangent has the direction of its tension [N] at that end.
inline Departure departAlong(const Machine& machine, Hand hand, const Eigen::Vector3d& tension) {
  const double sign = inwardSign(hand), radius = machine.sprocket_radius;
  const double angle = std::atan2(-tension.y(), sign * tension.x());
  const Eigen::Vector3d over(sign * std::sin(angle), std::cos(angle), 0);
  if (machine.over_top) return {angle, radius * angle, radius * over};
  return {angle, radius * (M_PI - angle), -radius * over};
}

/// Vector [mm] by which a mount gives under the tension [N] of the chain that leaves it.
inline Eigen::Vector3d mountGive(const ChainSide& side, const Eigen::Vector3d& tension) {
  return {side.inward * tension.x(), side.downward * tension.y(), 0};
}

/// Vector [mm] from the axis to the sprocket's own centre after `count` [mm] has been fed.
inline Eigen::Vector3d eccentricityAfter(const Machine& machine, Hand hand, double count) {
  const Eigen::Vector2d& at_zero = sideOf(machine, hand).eccentricity;
  // Chain over the top of the left sprocket turns it clockwise; the right hand and the lower feed
  // each reverse that.
  const double clockwise = inwardSign(hand) * (machine.over_top ? 1 : -1);
  const double turn = -clockwise * count / machine.sprocket_radius;
  return {std::cos(turn) * at_zero.x() - std::sin(turn) * at_zero.y(),
          std::sin(turn) * at_zero.x() + std::cos(turn) * at_zero.y(), 0};
}

}  // namespace reference
