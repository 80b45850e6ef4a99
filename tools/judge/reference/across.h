// A chain from sprocket to sprocket: no sled hangs on it, and its end is hooked on a tooth at 12
// o'clock, as for measuring the motor gap.
#pragma once

#include <Eigen/Core>

#include "reference/machine.h"

namespace reference {

/// A chain at rest between both sprockets.
struct Across {
  bool solved = false;
  Eigen::Vector3d pull = Eigen::Vector3d::Zero();  ///< [N] on the sprocket that pays it out
  Eigen::Vector3d other_pull = pull;               ///< [N] on the sprocket that holds its end
};

/// The chain of `hand` after `paid_out` [mm] of links, its end `beyond` [mm] of links past the
/// tooth at 12 o'clock of the other sprocket. Both sprockets carry it over their tops. The search
/// begins at `near` if that was solved. Not solved for a chain without weight that is not tight.
Across stretchAcross(const Machine& machine, Hand hand, double paid_out, double beyond,
                     const Across& near = Across());

}  // namespace reference
