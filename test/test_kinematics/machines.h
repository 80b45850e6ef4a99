// Machines and places for tests of the kinematics, in the form of lib/Kinematics and of the judge.
#pragma once

#include <vector>

#include "reference/reference.h"
#include "tried/tried.h"

const double kCloseEnough = 0.025;  // [mm] three encoder counts

/// The machine in the judge's numbers.
inline reference::Machine judgeOf(const Tried& tried) {
  reference::Machine machine;
  machine.motor_gap = tried.motor_gap;
  machine.motor_height = kHalfHeight + tried.motor_offset;
  machine.sprocket_radius = kSprocketRadius;
  machine.rotation_radius = tried.rotation_radius;
  machine.sled_weight = tried.sled_weight;
  machine.over_top = tried.over_top;
  for (reference::ChainSide* side : {&machine.left, &machine.right}) {
    side->weight = tried.chain_weight;
    side->compliance = tried.compliance;
  }
  machine.left.pitch = tried.left_pitch;
  machine.right.pitch = tried.right_pitch;
  return machine;
}

/// Places [mm] over the whole sheet and `beyond` its edges.
template <class Real>
std::vector<kinematics::Point<Real>> sheetPlaces(double beyond = 10, int columns = 33,
                                                 int rows = 17) {
  std::vector<kinematics::Point<Real>> places;
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j)
      places.push_back({Real((kHalfWidth + beyond) * (2.0 * i / (columns - 1) - 1)),
                        Real((kHalfHeight + beyond) * (2.0 * j / (rows - 1) - 1))});
  return places;
}
