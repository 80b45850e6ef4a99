// Eight equations as in hang.cpp, and a ninth: no moment about the centre of gravity.
#include "reference/two_brackets.h"

#include <Eigen/Dense>
#include <cmath>

#include "reference/newton.h"

namespace reference {

Eigen::Vector2d bracketFromBit(const TwoBrackets& sled, Hand hand, double tilt) {
  return Eigen::Rotation2Dd(tilt) *
         Eigen::Vector2d(-inwardSign(hand) * sled.mount_gap / 2, sled.mount_height);
}

Eigen::Vector2d centerFromBit(const TwoBrackets& sled, double tilt) {
  return Eigen::Rotation2Dd(tilt) * Eigen::Vector2d(0, -sled.center_depth);
}

double momentOf(const Machine& machine, const TwoBrackets& sled, double tilt, const ChainForm& left,
                const ChainForm& right) {
  const Eigen::Vector2d center = centerFromBit(sled, tilt);
  const auto moment = [](const Eigen::Vector2d& lever, const Eigen::Vector2d& force) {
    return lever.x() * force.y() - lever.y() * force.x();
  };
  return moment(bracketFromBit(sled, Hand::kLeft, tilt) - center, left.pull.head<2>()) +
         moment(bracketFromBit(sled, Hand::kRight, tilt) - center, right.pull.head<2>()) +
         moment(-center, machine.push);
}

namespace {

/// Pull left, pull right, tilt, then two lengths or a place.
using TiltedUnknowns = Eigen::Matrix<double, 9, 1>;

Eigen::Vector3d missOfBracket(const ChainForm& form, const TwoBrackets& sled, Hand hand,
                              double tilt, const Eigen::Vector2d& bit) {
  const Eigen::Vector2d bracket = bit + bracketFromBit(sled, hand, tilt);
  return form.ends - Eigen::Vector3d(bracket.x(), bracket.y(), 0);
}

TiltedUnknowns defects(const Machine& machine, const TwoBrackets& sled, double tilt,
                       const ChainForm& left, const ChainForm& right, const Eigen::Vector2d& bit) {
  const double arm = sled.mount_gap + sled.mount_height + sled.center_depth;
  TiltedUnknowns packed;
  packed << missOfBracket(left, sled, Hand::kLeft, tilt, bit) / machine.motor_gap,
      missOfBracket(right, sled, Hand::kRight, tilt, bit) / machine.motor_gap,
      unbalance(machine, left, right) / machine.sled_weight,
      momentOf(machine, sled, tilt, left, right) / (machine.sled_weight * arm);
  return packed;
}

TiltedUnknowns pack(const Machine& machine, const Eigen::Vector3d& left,
                    const Eigen::Vector3d& right, double tilt, const Eigen::Vector2d& rest) {
  TiltedUnknowns packed;
  packed << left / machine.sled_weight, right / machine.sled_weight, tilt, rest / machine.motor_gap;
  return packed;
}

TiltedHang tiltedHangOf(bool found, double tilt, const Eigen::Vector2d& bit, const ChainForm& left,
                        const ChainForm& right) {
  // A sled could rest upside down too, but no machine brings it there.
  const double least = std::remainder(tilt, 2 * M_PI);
  TiltedHang hang;
  static_cast<Hang&>(hang) = detail::hangOf(found && std::abs(least) < M_PI / 2, bit, left, right);
  hang.tilt = least;
  return hang;
}

/// Rough start at some tilt: straight chains from the axes carry the weight; moments are ignored.
TiltedUnknowns roughTilted(const Machine& machine, const TwoBrackets& sled,
                           const Eigen::Vector2d& bit, double tilt) {
  Eigen::Matrix2d span;  // from each bracket to its axis
  Eigen::Vector2d depth;
  for (Hand hand : {Hand::kLeft, Hand::kRight}) {
    const int side = hand == Hand::kLeft ? 0 : 1;
    const Eigen::Vector3d axis = axisAtRest(machine, hand);
    span.col(side) = axis.head<2>() - bit - bracketFromBit(sled, hand, tilt);
    depth[side] = axis.z();
  }
  const Eigen::Vector2d share =
      span.partialPivLu().solve(Eigen::Vector2d(0, machine.sled_weight));  // [N/mm]
  const auto pull = [&](int side) -> Eigen::Vector3d {
    return share[side] * Eigen::Vector3d(span(0, side), span(1, side), depth[side]);
  };
  return pack(machine, pull(0), pull(1), tilt, span.colwise().norm().transpose());
}

}  // namespace

TiltedHang hangTilted(const Machine& machine, const TwoBrackets& sled, const Eigen::Vector2d& bit) {
  const auto draw = [&](const TiltedUnknowns& packed, Hand hand) {
    const int side = hand == Hand::kLeft ? 0 : 1;
    return drawChain(
        machine, hand,
        {packed.segment<3>(3 * side) * machine.sled_weight, packed[7 + side] * machine.motor_gap});
  };
  const auto defect = [&](const TiltedUnknowns& packed) {
    return defects(machine, sled, packed[6], draw(packed, Hand::kLeft), draw(packed, Hand::kRight),
                   bit);
  };
  // Close below a motor the two brackets of a level sled are on different sides of it.
  for (double tilt : {0.0, 0.3, -0.3, 0.6, -0.6}) {
    const Root<9> root = findRoot<9>(defect, roughTilted(machine, sled, bit, tilt));
    const TiltedHang hang = tiltedHangOf(root.found, root.at[6], bit, draw(root.at, Hand::kLeft),
                                         draw(root.at, Hand::kRight));
    if (hang.solved) return hang;
  }
  return TiltedHang();
}

}  // namespace reference
