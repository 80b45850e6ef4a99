// A chain drawn from its sprocket, and its error at the ring.
#include "reference/statics.h"

#include <Eigen/Geometry>
#include <cmath>

#include "reference/catenary.h"

namespace reference {

ChainForm drawChain(const Machine& machine, Hand hand, const ChainGuess& guess) {
  const ChainSide& side = sideOf(machine, hand);
  const Eigen::Vector3d at_ring = -guess.pull;
  const Eigen::Vector3d at_sprocket = at_ring + side.weight * guess.free_length * downOf(machine);
  const Departure departure = departAlong(machine, hand, at_sprocket);
  ChainForm form;
  form.wrap = departure.wrap;
  form.free_length = guess.free_length;
  form.paid_out =
      departure.wrap + side.counted(guess.free_length, (at_sprocket.norm() + at_ring.norm()) / 2);
  form.departure_angle = departure.angle;
  form.tension_at_sprocket = at_sprocket.norm();
  form.tension_at_ring = at_ring.norm();
  form.leaves = axisAtRest(machine, hand) + mountGive(side, at_sprocket) +
                eccentricityAfter(machine, hand, form.paid_out) + departure.point;
  form.ends = form.leaves + spanOf(at_sprocket, at_ring, guess.free_length, side.compliance);
  form.pull = guess.pull;
  return form;
}

Eigen::Vector2d ringOf(const Machine& machine, const ChainForm& left, const ChainForm& right,
                       const Eigen::Vector2d& bit) {
  const double left_angle = std::atan2(left.pull.y(), -left.pull.x());
  const double right_angle = std::atan2(right.pull.y(), right.pull.x());
  const Eigen::Rotation2Dd turned((right_angle - left_angle) / 2);
  return bit + machine.bit_from_ring - turned * machine.bit_from_ring;
}

Eigen::Vector3d missOf(const Machine& machine, const ChainForm& form, const Eigen::Vector2d& ring) {
  const Eigen::Vector2d arm = machine.rotation_radius * form.pull.head<2>().normalized();
  return form.ends - Eigen::Vector3d(ring.x() + arm.x(), ring.y() + arm.y(), 0);
}

Eigen::Vector2d unbalance(const Machine& machine, const ChainForm& left, const ChainForm& right) {
  const Eigen::Vector3d weight = machine.sled_weight * downOf(machine);
  return (left.pull + right.pull + weight).head<2>() + machine.push;
}

bool isSound(const ChainForm& form, Hand hand) {
  return form.free_length > 0 && -inwardSign(hand) * form.pull.x() > 0 &&
         form.tension_at_sprocket < kBreakingPull && std::isfinite(form.paid_out);
}

}  // namespace reference
