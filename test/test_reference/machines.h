// Machines and places that the judge's tests share.
#pragma once

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "reference/reference.h"

/// Both chains alike.
inline reference::Machine withChains(reference::Machine machine, double weight, double compliance) {
  for (reference::ChainSide* side : {&machine.left, &machine.right}) {
    side->weight = weight;
    side->compliance = compliance;
  }
  return machine;
}

/// The machine of the published figures: 0.14 kg/m of chain, 5.17e-6 strain per newton.
inline reference::Machine defaultMachine() {
  return withChains(reference::Machine(), 0.00137293, 5.17e-6);
}

/// [mm left, right] The chains that hold the bit of a machine at a place.
inline Eigen::Vector2d lengthsOf(const reference::Machine& machine, const Eigen::Vector2d& bit) {
  const reference::Hang hang = reference::hangAt(machine, bit);
  EXPECT_TRUE(hang.solved);
  return hang.paid_out;
}

/// Places [mm] in `columns` x `rows` over the whole sheet and `beyond` its edges.
inline std::vector<Eigen::Vector2d> gridOver(int columns, int rows, double beyond = 0) {
  std::vector<Eigen::Vector2d> places;
  const double half_width = 1219.2 + beyond, half_height = 609.6 + beyond;
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j)
      places.emplace_back(half_width * (2.0 * i / (columns - 1) - 1),
                          half_height * (2.0 * j / (rows - 1) - 1));
  return places;
}

/// Draws machines, and places for them, from all that the judge is meant for.
class Lottery {
 public:
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(source_);
  }
  bool chance(double share) { return between(0, 1) < share; }

  Eigen::Vector2d drawPlace() { return {between(-1229.2, 1229.2), between(-619.6, 619.6)}; }

  reference::ChainSide drawSide() {
    reference::ChainSide side;
    side.weight = chance(0.2) ? 0 : between(0, 0.0025);
    side.compliance = chance(0.2) ? 0 : between(0, 2e-5);
    side.pitch = between(-0.003, 0.003);
    side.zero = between(-10, 10);
    return side;
  }

  /// A machine with everything that stays in the sheet's plane.
  reference::Machine drawMachine() {
    reference::Machine machine;
    machine.motor_gap = between(2900, 3700);
    machine.motor_height = 609.6 + between(300, 900);
    machine.sled_weight = between(60, 150);
    machine.rotation_radius = between(0, 250);
    machine.over_top = chance(0.5);
    machine.left = drawSide();
    machine.right = drawSide();
    return machine;
  }

  /// That machine with everything that moves the mounts, pushes the sled or leaves the plane.
  reference::Machine drawFullMachine() {
    reference::Machine machine = drawMachine();
    machine.motor_center_x = between(-20, 20);
    machine.height_difference = between(-20, 20);
    machine.lean = between(0, 0.35);
    machine.plane_gap = between(-60, 60);
    machine.push = {between(-5, 5), between(-5, 5)};
    for (reference::ChainSide* side : {&machine.left, &machine.right}) {
      side->inward = between(0, 0.02);
      side->downward = between(0, 0.02);
      side->eccentricity = {between(-0.2, 0.2), between(-0.2, 0.2)};
    }
    return machine;
  }

 private:
  std::mt19937 source_{20180901};
};
