// A hanging machine as it really is: the numbers from which the judge's mechanics start.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "reference/links.h"

namespace reference {

/// A chain with the motor from which it hangs. Zero in any field means that the effect is absent.
/// Weight and compliance are per mm of the real chain, with its long links.
struct ChainSide : Links {
  double weight = 0;      ///< [N/mm] of chain without load on it
  double compliance = 0;  ///< [1/N] strain per newton of local tension
  double inward = 0;      ///< [mm/N] give of the mount towards the other mount, per horizontal pull
  double downward = 0;    ///< [mm/N] give of the mount downwards, per vertical pull

  /// [mm] From the axis to the middle of the sprocket, (x, y), when the count is zero.
  Eigen::Vector2d eccentricity = Eigen::Vector2d::Zero();
};

/// Frame, sled and both chains. Origin in the middle of the sheet, x right, y up along it, z off
/// it.
struct Machine {
  double motor_gap = 2978.4;     ///< [mm] between the sprocket axes
  double motor_height = 1072.6;  ///< [mm] mean of both axes above the middle of the sheet
  double motor_center_x = 0;     ///< [mm] midpoint of the axes right of the middle of the sheet
  double height_difference = 0;  ///< [mm] right axis minus left axis
  double sprocket_radius = 63.5 / (2 * M_PI);  ///< [mm] feed radius: chain per turn / (2 pi)
  double rotation_radius = 139.1;              ///< [mm] from the bit to where the free chain ends
  double sled_weight = 97.9;                   ///< [N] the full weight, also on a leaning frame
  bool over_top = true;  ///< the chain leaves over the top of the sprocket, else below
  double lean = 0;       ///< [rad] of the sheet from the vertical, top away from the sled
  double plane_gap = 0;  ///< [mm] sprockets farther from the sheet than the ring

  /// [mm] the bit from the ring's centre on an upright sled; the sled turns with its chains.
  Eigen::Vector2d bit_from_ring = Eigen::Vector2d::Zero();

  /// [N] Force on the sled along the sheet in addition to weight and chains, such as friction.
  Eigen::Vector2d push = Eigen::Vector2d::Zero();

  ChainSide left, right;
};

/// The direction along x from a motor to the middle.
enum class Hand { kLeft = +1, kRight = -1 };

/// +1 for the left chain, -1 for the right chain: times this, x points inwards.
inline double inwardSign(Hand hand) { return hand == Hand::kLeft ? 1.0 : -1.0; }

/// That side's chain and motor.
inline const ChainSide& sideOf(const Machine& machine, Hand hand) {
  return hand == Hand::kLeft ? machine.left : machine.right;
}

/// [1] unit vector along which weight acts, in the sheet's frame.
inline Eigen::Vector3d downOf(const Machine& machine) {
  return {0, -std::cos(machine.lean), -std::sin(machine.lean)};
}

/// [mm] Where a sprocket's axis is while nothing pulls on it.
inline Eigen::Vector3d axisAtRest(const Machine& machine, Hand hand) {
  const double sign = inwardSign(hand);
  return {machine.motor_center_x - sign * machine.motor_gap / 2,
          machine.motor_height - sign * machine.height_difference / 2, machine.plane_gap};
}

}  // namespace reference
