// From chains paid out to the place where the sled comes to rest.
#pragma once

#include <Eigen/Core>

#include "reference/hang.h"

namespace reference {

/// Where the sled came to rest. Unless `solved`, no other field means anything.
struct Settled {
  bool solved = false;
  Eigen::Vector2d bit = Eigen::Vector2d::Zero();  ///< [mm] where the bit is
  Hang hang;                                      ///< the chains there
};

/// The chain's own length [mm] when the motor has counted `paid_out` [mm] and the end pulls thus.
ChainForm drawCounted(const Machine& machine, Hand hand, const Eigen::Vector3d& pull,
                      double paid_out);

/// Newton from a sled known to be at rest to nearby lengths `paid_out` [mm left, right].
Hang settleFrom(const Machine& machine, const Hang& start, const Eigen::Vector2d& paid_out);

/// The place where the sled rests on chains of `paid_out` [mm left, right], looked for from
/// `start` [mm], which must be a place where it could hang.
Settled settle(const Machine& machine, const Eigen::Vector2d& paid_out,
               const Eigen::Vector2d& start = Eigen::Vector2d::Zero());

}  // namespace reference
