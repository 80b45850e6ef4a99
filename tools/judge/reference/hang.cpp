// Eight equations for a place: both pulls and both free lengths.
#include "reference/hang.h"

#include "reference/newton.h"

namespace reference {

ChainGuess roughChain(const Machine& machine, Hand hand, const Eigen::Vector2d& bit) {
  const Hand other_hand = hand == Hand::kLeft ? Hand::kRight : Hand::kLeft;
  const Eigen::Vector2d to_axis = axisAtRest(machine, hand).head<2>() - bit;
  const Eigen::Vector2d to_other = axisAtRest(machine, other_hand).head<2>() - bit;
  const double load = machine.sled_weight + (sideOf(machine, hand).weight * to_axis.norm() +
                                             sideOf(machine, other_hand).weight * to_other.norm()) /
                                                2;
  // Lever rule about the other motor.
  const double crossed = to_axis.x() * to_other.y() - to_axis.y() * to_other.x();
  const double per_length = -load * to_other.x() / crossed;
  Eigen::Vector3d pull(per_length * to_axis.x(), per_length * to_axis.y(), 0);
  pull.z() = pull.head<2>().norm() * machine.plane_gap / to_axis.norm();
  return {pull, to_axis.norm() - machine.rotation_radius};
}

namespace detail {

Unknowns pack(const Machine& machine, const Eigen::Vector3d& left, const Eigen::Vector3d& right,
              const Eigen::Vector2d& rest) {
  Unknowns packed;
  packed << left / machine.sled_weight, right / machine.sled_weight, rest / machine.motor_gap;
  return packed;
}

Unknowns defects(const Machine& machine, const ChainForm& left, const ChainForm& right,
                 const Eigen::Vector2d& bit) {
  const Eigen::Vector2d ring = ringOf(machine, left, right, bit);
  Unknowns packed;
  packed << missOf(machine, left, ring) / machine.motor_gap,
      missOf(machine, right, ring) / machine.motor_gap,
      unbalance(machine, left, right) / machine.sled_weight;
  return packed;
}

Hang hangOf(bool found, const Eigen::Vector2d& bit, const ChainForm& left, const ChainForm& right) {
  const bool solved = found && isSound(left, Hand::kLeft) && isSound(right, Hand::kRight);
  if (!solved) return Hang();
  return {true, bit, {left.paid_out, right.paid_out}, left, right};
}

}  // namespace detail

Hang hangAt(const Machine& machine, const Eigen::Vector2d& bit) {
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
