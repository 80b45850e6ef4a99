// From chains paid out to the place where the sled comes to rest.
#pragma once

#include <Eigen/Core>

#include "reference/hang.h"

namespace reference {

/// The chain's length [mm] without load when the motor has counted `paid_out` [mm] and the chain
/// pulls like this at its end.
ChainForm drawCounted(const Machine& machine, Hand hand, const Eigen::Vector3d& pull,
                      double paid_out);

/// Newton's method from a sled at rest to nearby lengths `paid_out` [mm left, right].
Hang settleFrom(const Machine& machine, const Hang& start, const Eigen::Vector2d& paid_out);

/// The place where the sled rests on chains of `paid_out` [mm left, right]. The search starts at
/// `start` [mm], where a sled must be able to hang.
Hang settle(const Machine& machine, const Eigen::Vector2d& paid_out,
            const Eigen::Vector2d& start = Eigen::Vector2d::Zero());

}  // namespace reference
