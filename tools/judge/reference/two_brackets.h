// The older sled, held at two brackets: a rigid body at rest under two chains and its weight.
#pragma once

#include <Eigen/Core>

#include "reference/hang.h"

namespace reference {

/// A rigid sled while it hangs level.
struct TwoBrackets {
  double mount_gap = 310;     ///< [mm] between the brackets, the bit midway
  double mount_height = 139;  ///< [mm] brackets above the bit
  double center_depth = 79;   ///< [mm] centre of gravity below the bit
};

/// A tilted sled at rest. The tilt too is valid only if `solved`.
struct TiltedHang : Hang {
  double tilt = 0;  ///< [rad] counterclockwise
};

/// [mm] from the bit to a bracket.
Eigen::Vector2d bracketFromBit(const TwoBrackets& sled, Hand hand, double tilt);

/// [mm] from the bit to the centre of gravity.
Eigen::Vector2d centerFromBit(const TwoBrackets& sled, double tilt);

/// [N mm] Moment about the centre of gravity of both pulls on the brackets and of a push on the
/// bit; the weight has no moment there.
double momentOf(const Machine& machine, const TwoBrackets& sled, double tilt, const ChainForm& left,
                const ChainForm& right);

/// The chains and the tilt that hold the sled still with its bit at `bit` [mm].
TiltedHang hangTilted(const Machine& machine, const TwoBrackets& sled, const Eigen::Vector2d& bit);

}  // namespace reference
