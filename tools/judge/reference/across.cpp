// Three equations for a chain between two sprockets: both of its ends are where it is held.
#include "reference/across.h"

#include <cmath>

#include "reference/catenary.h"
#include "reference/newton.h"
#include "reference/sprocket.h"
#include "reference/statics.h"

namespace reference {
namespace {

/// A chain that leaves its sprocket with a tension, and how far it misses the other sprocket.
struct Stretched {
  Eigen::Vector3d ends_with;  ///< [N] tension at the far end, along the chain
  Eigen::Vector3d span, miss;
  double free_length;
};

Eigen::Vector3d placeOf(const Machine& machine, Hand hand, const Eigen::Vector3d& pull,
                        double count) {
  return axisAtRest(machine, hand) + mountGive(sideOf(machine, hand), pull) +
         eccentricityAfter(machine, hand, count) + departAlong(machine, hand, pull).point;
}

Stretched stretched(const Machine& machine, Hand hand, double paid_out, double beyond,
                    const Eigen::Vector3d& starts_with) {
  const Hand other = hand == Hand::kLeft ? Hand::kRight : Hand::kLeft;
  const ChainSide& side = sideOf(machine, hand);
  // Its whole weight lies between both tensions; links on the teeth hardly matter for that.
  const Eigen::Vector3d weight = side.weight * machine.motor_gap * downOf(machine);
  Stretched chain;
  chain.ends_with = starts_with - weight;
  for (int round = 0; round < 4; ++round) {
    const double wraps = departAlong(machine, hand, starts_with).wrap +
                         departAlong(machine, other, -chain.ends_with).wrap;
    const double tension = (starts_with.norm() + chain.ends_with.norm()) / 2;
    chain.free_length = side.lengthOf(paid_out - beyond - wraps, tension);
    chain.ends_with = starts_with - side.weight * chain.free_length * downOf(machine);
  }
  chain.span = spanOf(starts_with, chain.ends_with, chain.free_length, side.compliance);
  chain.miss = placeOf(machine, hand, starts_with, paid_out) + chain.span -
               placeOf(machine, other, -chain.ends_with, 0);
  return chain;
}

/// A parabola's tension, or a modest tension for a chain that is tight.
Eigen::Vector3d roughPull(const Machine& machine, Hand hand, double excess) {
  const double kModest = 50, kLeastExcess = 0.5;  // [N], [mm]
  const double gap = machine.motor_gap, weight = sideOf(machine, hand).weight * gap;
  const double level = excess > kLeastExcess ? weight * std::sqrt(gap / (24 * excess)) : kModest;
  return Eigen::Vector3d(inwardSign(hand) * level, 0, 0) + weight / 2 * downOf(machine);
}

}  // namespace

Across stretchAcross(const Machine& machine, Hand hand, double paid_out, double beyond,
                     const Across& near) {
  Machine over = machine;
  over.over_top = true;
  const double kUnit = 100;  // [N]
  const auto defect = [&](const Eigen::Vector3d& at) -> Eigen::Vector3d {
    return stretched(over, hand, paid_out, beyond, at * kUnit).miss / over.motor_gap;
  };
  const double excess = sideOf(over, hand).lengthOf(paid_out - beyond, 0) - over.motor_gap;
  const Eigen::Vector3d first = near.solved ? near.pull : roughPull(over, hand, excess);
  const Root<3> root = findRoot<3>(defect, first / kUnit);
  const Eigen::Vector3d pull = root.at * kUnit;
  if (!root.found || inwardSign(hand) * pull.x() <= 0 || pull.norm() >= kBreakingPull)
    return Across();
  return {true, pull, -stretched(over, hand, paid_out, beyond, pull).ends_with};
}

}  // namespace reference
