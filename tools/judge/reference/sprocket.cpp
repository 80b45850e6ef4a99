// Tangents, mounts that give, and sprockets that run out.
#include "reference/sprocket.h"

#include <cmath>

namespace reference {

Departure departAlong(const Machine& machine, Hand hand, const Eigen::Vector3d& tension) {
  const double sign = inwardSign(hand), radius = machine.sprocket_radius;
  const double angle = std::atan2(-tension.y(), sign * tension.x());
  const Eigen::Vector3d over(sign * std::sin(angle), std::cos(angle), 0);
  if (machine.over_top) return {angle, radius * angle, radius * over};
  return {angle, radius * (M_PI - angle), -radius * over};
}

Eigen::Vector3d mountGive(const ChainSide& side, const Eigen::Vector3d& tension) {
  return {side.inward * tension.x(), side.downward * tension.y(), 0};
}

Eigen::Vector3d eccentricityAfter(const Machine& machine, Hand hand, double count) {
  const Eigen::Vector2d& at_zero = sideOf(machine, hand).eccentricity;
  // Paying out over the top turns the left sprocket clockwise. The right side and the feed off the
  // bottom each reverse that.
  const double clockwise = inwardSign(hand) * (machine.over_top ? 1 : -1);
  const double turn = -clockwise * count / machine.sprocket_radius;
  return {std::cos(turn) * at_zero.x() - std::sin(turn) * at_zero.y(),
          std::sin(turn) * at_zero.x() + std::cos(turn) * at_zero.y(), 0};
}

}  // namespace reference
