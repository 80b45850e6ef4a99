// Where a chain leaves its sprocket, and how much chain is on the teeth.
#pragma once

#include <Eigen/Core>

#include "reference/machine.h"

namespace reference {

/// The place where a chain leaves the teeth.
struct Departure {
  double angle;           ///< [rad] of the leaving chain below the horizontal
  double wrap;            ///< [mm] of chain on the teeth from 12 o'clock to here
  Eigen::Vector3d point;  ///< [mm] from the middle of the sprocket
};

/// The chain leaves where the circle's tangent has the direction of the tension [N] at that end.
Departure departAlong(const Machine& machine, Hand hand, const Eigen::Vector3d& tension);

/// Vector [mm] by which a mount gives under the tension [N] of the chain that leaves it.
Eigen::Vector3d mountGive(const ChainSide& side, const Eigen::Vector3d& tension);

/// Vector [mm] from the axis to the middle of the sprocket after `count` [mm] was paid out.
Eigen::Vector3d eccentricityAfter(const Machine& machine, Hand hand, double count);

}  // namespace reference
