// From a place to the chains that hold the sled there.
#pragma once

#include <Eigen/Core>

#include "reference/newton.h"
#include "reference/statics.h"

namespace reference {

/// A sled at rest. Unless `solved`, no other field means anything.
struct Hang {
  bool solved = false;
  Eigen::Vector2d bit = Eigen::Vector2d::Zero();       ///< [mm] where the bit is
  Eigen::Vector2d paid_out = Eigen::Vector2d::Zero();  ///< [mm] counted left, right
  ChainForm left, right;
};

/// Rough start: straight chains from the axes to the bit that share the weight.
inline ChainGuess roughChain(const Machine& machine, Hand hand, const Eigen::Vector2d& bit) {
  const Hand other_hand = hand == Hand::kLeft ? Hand::kRight : Hand::kLeft;
  const Eigen::Vector2d own = axisAtRest(machine, hand).head<2>() - bit;
  const Eigen::Vector2d other = axisAtRest(machine, other_hand).head<2>() - bit;
  const double load = machine.sled_weight + (sideOf(machine, hand).weight * own.norm() +
                                             sideOf(machine, other_hand).weight * other.norm()) /
                                                2;
  // Lever rule about the other motor.
  const double crossed = own.x() * other.y() - own.y() * other.x();
  const double per_length = -load * other.x() / crossed;
  Eigen::Vector3d pull(per_length * own.x(), per_length * own.y(), 0);
  pull.z() = pull.head<2>().norm() * machine.plane_gap / own.norm();
  return {pull, own.norm() - machine.rotation_radius};
}

namespace detail {

using Unknowns = Eigen::Matrix<double, 8, 1>;  // pull left, pull right, then two lengths or a place

inline Unknowns pack(const Machine& machine, const Eigen::Vector3d& left,
                     const Eigen::Vector3d& right, const Eigen::Vector2d& rest) {
  Unknowns packed;
  packed << left / machine.sled_weight, right / machine.sled_weight, rest / machine.motor_gap;
  return packed;
}

inline Unknowns defects(const Machine& machine, const ChainForm& left, const ChainForm& right,
                        const Eigen::Vector2d& bit) {
  const Eigen::Vector2d ring = ringOf(machine, left, right, bit);
  Unknowns packed;
  packed << missOf(machine, left, ring) / machine.motor_gap,
      missOf(machine, right, ring) / machine.motor_gap,
      unbalance(machine, left, right) / machine.sled_weight;
  return packed;
}

inline Hang hangOf(bool found, const Eigen::Vector2d& bit, const ChainForm& left,
                   const ChainForm& right) {
  const bool solved = found && isSound(left, Hand::kLeft) && isSound(right, Hand::kRight);
  if (!solved) return Hang();
  return {true, bit, {left.paid_out, right.paid_out}, left, right};
}

}  // namespace detail

/// The chains that hold the sled still with its bit at `bit` [mm].
inline Hang hangAt(const Machine& machine, const Eigen::Vector2d& bit) {
  using detail::Unknowns;
  const auto draw = [&](const Unknowns& packed, Hand hand) {
    const int side = hand == Hand::kLeft ? 0 : 1;
    return drawChain(
        machine, hand,
        {packed.segment<3>(3 * side) * machine.sled_weight, packed[6 + side] * machine.motor_gap});
  };
  const auto defect = [&](const Unknowns& packed) {
    return detail::defects(machine, draw(packed, Hand::kLeft), draw(packed, Hand::kRight), bit);
  };
  const ChainGuess left = roughChain(machine, Hand::kLeft, bit);
  const ChainGuess right = roughChain(machine, Hand::kRight, bit);
  const Root<8> root = findRoot<8>(
      defect, detail::pack(machine, left.pull, right.pull, {left.free_length, right.free_length}));
  return detail::hangOf(root.found, bit, draw(root.at, Hand::kLeft), draw(root.at, Hand::kRight));
}

}  // namespace reference
