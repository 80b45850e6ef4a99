// The eight equations of hang.cpp, solved for given lengths: the unknowns are both pulls and the
// place.
#include "reference/settle.h"

#include <cmath>

#include "reference/newton.h"

namespace reference {

namespace {

/// The chain when its motor has counted `paid_out` [mm] and it pulls like this at its end.
ChainForm drawCounted(const Machine& machine, Hand hand, const Eigen::Vector3d& pull,
                      double paid_out) {
  const ChainSide& side = sideOf(machine, hand);
  // The wrap depends on the slope at the sprocket, the slope on the chain's weight, and so on its
  // length. Each round shrinks the error by radius * weight / tension, about 1e-3.
  double free_length = paid_out;
  for (int i = 0; i < 40; ++i) {
    const Eigen::Vector3d tension = -pull + side.weight * free_length * downOf(machine);
    const double wrap = departAlong(machine, hand, tension).wrap;
    const double better = side.lengthOf(paid_out - wrap, (tension.norm() + pull.norm()) / 2);
    const bool same = std::abs(better - free_length) < 1e-13 * machine.motor_gap;
    free_length = better;
    if (same) break;
  }
  return drawChain(machine, hand, {pull, free_length});
}

}  // namespace

Hang settleFrom(const Machine& machine, const Hang& start, const Eigen::Vector2d& paid_out) {
  using detail::Unknowns;
  const auto draw = [&](const Unknowns& packed, Hand hand) {
    const int side = hand == Hand::kLeft ? 0 : 1;
    return drawCounted(machine, hand, packed.segment<3>(3 * side) * machine.sled_weight,
                       paid_out[side]);
  };
  const auto defect = [&](const Unknowns& packed) {
    return detail::defects(machine, draw(packed, Hand::kLeft), draw(packed, Hand::kRight),
                           packed.tail<2>() * machine.motor_gap);
  };
  const Root<8> root =
      findRoot<8>(defect, detail::pack(machine, start.left.pull, start.right.pull, start.bit));
  return detail::hangOf(root.found, root.at.tail<2>() * machine.motor_gap,
                        draw(root.at, Hand::kLeft), draw(root.at, Hand::kRight));
}

Hang settle(const Machine& machine, const Eigen::Vector2d& paid_out, const Eigen::Vector2d& start) {
  const Hang first = hangAt(machine, start);
  return first.solved ? settleFrom(machine, first, paid_out) : first;
}

}  // namespace reference
