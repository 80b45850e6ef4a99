// The equations of a hanging sled: both chains must end on the ring, and the forces must balance.
#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "reference/catenary.h"
#include "reference/machine.h"
#include "reference/sprocket.h"

namespace reference {

/// What describes one chain while the solution is being looked for.
struct ChainGuess {
  Eigen::Vector3d pull;  ///< [N] of the chain on the ring
  double free_length;    ///< [mm] from sprocket to ring, as it would be without load on it
};

/// One chain drawn from its sprocket, whether or not it arrives where it should.
struct ChainForm {
  double paid_out = 0;             ///< [mm] what the motor has counted, in nominal links
  double wrap = 0;                 ///< [mm] of it on the teeth, from 12 o'clock
  double free_length = 0;          ///< [mm] from sprocket to ring, as it would be without load
  double departure_angle = 0;      ///< [rad] of the chain below the horizontal at the sprocket
  double tension_at_sprocket = 0;  ///< [N]
  double tension_at_ring = 0;      ///< [N]
  Eigen::Vector3d leaves = Eigen::Vector3d::Zero();  ///< [mm] point where it leaves the teeth
  Eigen::Vector3d ends = Eigen::Vector3d::Zero();    ///< [mm] point where it ends
  Eigen::Vector3d pull = Eigen::Vector3d::Zero();    ///< [N] of the chain on the ring
};

/// Draws a chain from its sprocket downwards.
inline ChainForm drawChain(const Machine& machine, Hand hand, const ChainGuess& guess) {
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

/// [mm] where the ring's centre is while the bit is at `bit`. The sled turns as its chains do, by
/// half the difference of both pulls' angles, and carries its bit around the ring.
inline Eigen::Vector2d ringOf(const Machine& machine, const ChainForm& left, const ChainForm& right,
                              const Eigen::Vector2d& bit) {
  const double left_angle = std::atan2(left.pull.y(), -left.pull.x());
  const double right_angle = std::atan2(right.pull.y(), right.pull.x());
  const Eigen::Rotation2Dd turned((right_angle - left_angle) / 2);
  return bit + machine.bit_from_ring - turned * machine.bit_from_ring;
}

/// Vector [mm] from the ring to a chain's end: zero when the chain fits.
///
/// The arm has no weight and turns freely about the bit, so it lines up with the pull on it. It
/// stays in its plane: what pulls off the sheet is taken by the sheet.
inline Eigen::Vector3d missOf(const Machine& machine, const ChainForm& form,
                              const Eigen::Vector2d& ring) {
  const Eigen::Vector2d arm = machine.rotation_radius * form.pull.head<2>().normalized();
  return form.ends - Eigen::Vector3d(ring.x() + arm.x(), ring.y() + arm.y(), 0);
}

/// [N] force within the sheet that is left over on the sled: zero when it is at rest.
inline Eigen::Vector2d unbalance(const Machine& machine, const ChainForm& left,
                                 const ChainForm& right) {
  const Eigen::Vector3d weight = machine.sled_weight * downOf(machine);
  return (left.pull + right.pull + weight).head<2>() + machine.push;
}

const double kBreakingPull = 3500;  // [N] the least that makers of No. 25 roller chain state

/// A chain can only pull: it reaches inwards from its motor, has a length, and has not snapped.
inline bool isSound(const ChainForm& form, Hand hand) {
  return form.free_length > 0 && -inwardSign(hand) * form.pull.x() > 0 &&
         form.tension_at_sprocket < kBreakingPull && std::isfinite(form.paid_out);
}

}  // namespace reference
