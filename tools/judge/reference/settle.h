// From chains paid out to the place where the sled comes to rest.
#pragma once

#include <Eigen/Core>

#include "reference/hang.h"

namespace reference {

/// Newton's method from a sled at rest to nearby lengths `paid_out` [mm left, right].
Hang settleFrom(const Machine& machine, const Hang& start, const Eigen::Vector2d& paid_out);

/// The place where the sled rests on chains of `paid_out` [mm left, right]. The search starts at
/// `start` [mm], where a sled must be able to hang.
Hang settle(const Machine& machine, const Eigen::Vector2d& paid_out,
            const Eigen::Vector2d& start = Eigen::Vector2d::Zero());

}  // namespace reference
