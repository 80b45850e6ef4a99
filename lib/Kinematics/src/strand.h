// The basic terms: a place, the frame, and a strand of chain from sprocket to sled.
#pragma once

#include <stdint.h>

namespace kinematics {

/// A place on the sheet; the origin is the sheet's middle, x to the right, y up.
template <class Real>
struct Point {
  Real x, y;  ///< [mm]
};

/// Chain paid out past 12 o'clock of each sprocket, measured in nominal links (6.35 mm each).
template <class Real>
struct Chains {
  Real left, right;  ///< [mm]
};

/// Which side of its sprocket a chain leaves by on its way to the sled.
enum class Feed : uint8_t { kOverTop, kOffBottom };

/// Left and right, used as an index.
enum Side : uint8_t { kLeft, kRight, kSideCount };

/// Numbers of every hanging machine, with or without effects.
template <class Real>
struct Frame {
  Real motor_gap;        ///< [mm] between the sprocket centres
  Real motor_height;     ///< [mm] sprocket centres above the middle of the sheet
  Real motor_center_x;   ///< [mm] middle of the sprockets right of the middle of the sheet
  Real rotation_radius;  ///< [mm] bit to the end of the chain: the ring and its link, no chain
  Real sprocket_radius;  ///< [mm] chain fed per radian: teeth * pitch / (2 pi)
  Real sled_weight;      ///< [N] sled, router and bricks, in the plane of the sheet
  Real chain_weight;     ///< [N/mm] of chain
  Feed feed;             ///< how the chains leave the sprockets
};

/// A chain between its sprocket and the bit, drawn straight, and what it carries.
///
/// "Straight" is the line that touches the sprocket and passes through the bit. The last
/// rotation_radius of the line is the ring's arm, the rest is free chain.
template <class Real, bool kWithForces = true>
struct Strand;

/// What every drawing of it says.
template <class Real>
struct Strand<Real, false> {
  Side side;
  Real free;    ///< [mm] straight chain between sprocket and arm
  Real length;  ///< [mm] free chain in nominal links: what the effects adjust
  Real wrap;    ///< [mm] sprocket_radius * angle: chain on the teeth, without the term r^2 / d
};

/// The same with its direction and what it carries, which are worked out only where it is asked.
template <class Real>
struct Strand<Real, true> : Strand<Real, false> {
  bool deep;          ///< the chains hang so deep that the second order of sag counts
  Real pull;          ///< [1] tension / sled weight; only where an effect asks for forces
  Real slack;         ///< [1] 1 / pull
  Real bend;          ///< [1] cosine / pull: how easily its weight bends the chain
  Real sine, cosine;  ///< [1] of the straight line's angle below the horizontal
  Real lean;          ///< [1] sine / pull; only on deep machines
  Real ease;          ///< [1] share by which deep chains pull less; only on deep machines
};

/// Forces of both strands on the sprockets and the sled, in sled weights.
template <class Real>
struct Forces {
  Real level;                ///< [1] horizontal pull, the same in both strands
  Real upright[kSideCount];  ///< [1] vertical pull of each strand; together they hold the load

  Real levelOf(Side) const { return level; }

  /// The difference right less left, each divided by the level pull of its side.
  Real differencePerLevel(Real left, Real right) const { return (right - left) / level; }
};

/// Forces of both strands where something pushes the sled: their level pulls then differ.
template <class Real>
struct PushedForces {
  Real level[kSideCount];    ///< [1] horizontal pull of each strand
  Real upright[kSideCount];  ///< [1] vertical pull of each

  Real levelOf(Side side) const { return level[side]; }
  Real differencePerLevel(Real left, Real right) const {
    return right / level[kRight] - left / level[kLeft];
  }
};

}  // namespace kinematics
