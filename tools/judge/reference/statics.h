// The equations of a hanging sled: both chains must end on the ring, and the forces must balance.
#pragma once

#include <Eigen/Core>

#include "reference/machine.h"
#include "reference/sprocket.h"

namespace reference {

/// The unknowns of a chain during the search.
struct ChainGuess {
  Eigen::Vector3d pull;  ///< [N] of the chain on the ring
  double free_length;    ///< [mm] from sprocket to ring, without load
};

/// A chain drawn from its sprocket, whether or not it ends at the ring.
struct ChainForm {
  double paid_out = 0;             ///< [mm] counted by the motor, in nominal links
  double wrap = 0;                 ///< [mm] of chain on the teeth, from 12 o'clock
  double free_length = 0;          ///< [mm] from sprocket to ring, as it would be without load
  double departure_angle = 0;      ///< [rad] of the chain below the horizontal at the sprocket
  double tension_at_sprocket = 0;  ///< [N]
  double tension_at_ring = 0;      ///< [N]
  Eigen::Vector3d leaves = Eigen::Vector3d::Zero();  ///< [mm] point where it leaves the teeth
  Eigen::Vector3d ends = Eigen::Vector3d::Zero();    ///< [mm] point where it ends
  Eigen::Vector3d pull = Eigen::Vector3d::Zero();    ///< [N] of the chain on the ring
};

/// Draws a chain from its sprocket downwards.
ChainForm drawChain(const Machine& machine, Hand hand, const ChainGuess& guess);

/// [mm] Where the ring's centre is while the bit is at `bit`. The sled turns with its chains, by
/// half the difference of both pulls' angles, and carries its bit around the ring.
Eigen::Vector2d ringOf(const Machine& machine, const ChainForm& left, const ChainForm& right,
                       const Eigen::Vector2d& bit);

/// Vector [mm] from the ring to a chain's end: zero when the chain fits.
///
/// The arm has no weight and turns freely about the bit, so it lines up with the pull on it. It
/// stays in its plane: the sheet takes the part of the pull across it.
Eigen::Vector3d missOf(const Machine& machine, const ChainForm& form, const Eigen::Vector2d& ring);

/// [N] Sum of the forces on the sled along the sheet: zero when it is at rest.
Eigen::Vector2d unbalance(const Machine& machine, const ChainForm& left, const ChainForm& right);

const double kBreakingPull = 3500;  // [N] least value that makers of No. 25 roller chain state

/// Whether a chain can pull like this: it reaches inwards from its motor, has a length, is not
/// torn.
bool isSound(const ChainForm& form, Hand hand);

}  // namespace reference
