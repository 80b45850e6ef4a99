// From a place to the chains that hold the sled there.
#pragma once

#include <Eigen/Core>

#include "reference/statics.h"

namespace reference {

/// A sled at rest. The other fields are valid only if `solved`.
struct Hang {
  bool solved = false;
  Eigen::Vector2d bit = Eigen::Vector2d::Zero();       ///< [mm] where the bit is
  Eigen::Vector2d paid_out = Eigen::Vector2d::Zero();  ///< [mm] counted left, right
  ChainForm left, right;
};

/// Rough start: straight chains from the axes to the bit that share the weight.
ChainGuess roughChain(const Machine& machine, Hand hand, const Eigen::Vector2d& bit);

namespace detail {

using Unknowns = Eigen::Matrix<double, 8, 1>;  // pull left, pull right, then two lengths or a place

Unknowns pack(const Machine& machine, const Eigen::Vector3d& left, const Eigen::Vector3d& right,
              const Eigen::Vector2d& rest);

Unknowns defects(const Machine& machine, const ChainForm& left, const ChainForm& right,
                 const Eigen::Vector2d& bit);

Hang hangOf(bool found, const Eigen::Vector2d& bit, const ChainForm& left, const ChainForm& right);

}  // namespace detail

/// The chains that hold the sled still with its bit at `bit` [mm].
Hang hangAt(const Machine& machine, const Eigen::Vector2d& bit);

}  // namespace reference
