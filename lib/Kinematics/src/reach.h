// Where a place is usable: what both chains carry there, and how far a force moves the sled.
#pragma once

#include "Kinematics.h"

namespace kinematics {

/// Verdict on a place. Where several hold, the answer is the first of kCannotHang, kTooTight,
/// kTooSlack, kTooVertical.
enum class Reach : uint8_t {
  kUsable,
  kTooTight,     ///< too near the line of the motors: a chain pulls more than its gearbox should
  kTooSlack,     ///< a chain pulls too little to hold its gears: the far chain in a lower corner
  kTooVertical,  ///< under a motor, where only a slack chain keeps the sled from giving sideways
  kCannotHang,   ///< no sled hangs there (see Found), or its ring would touch a sprocket
};

/// Limits of a usable place.
template <class Real>
struct ReachLimits {
  /// [N] of a chain at its sprocket. Motors stall near 290 N; a third of that is reserved for
  /// starting, friction and the hose. (The chain itself carries 640 N for long.)
  Real most_tension = Real(200);

  /// [N] of a chain at its sprocket. The bungee on the other end of the chain pulls about 18 N.
  /// Where the sled pulls less, the gears lie against their other flanks: the sled jumps by their
  /// play.
  Real least_tension = Real(18);

  /// [mm] of chain between ring and sprocket, so that the ring's carriage stays clear.
  Real least_free = Real(100);

  /// [mm/N] in the direction in which the sled gives most. At this limit a light cut, 10 N, pushes
  /// the bit aside by its width (a quarter inch), and friction of 7 N leaves it 4 mm to either
  /// side of where it should be. Calibration marks need a tenth of this limit.
  Real most_give = Real(0.6);
};

/// How far the bit moves [mm] per newton of force on the sled, along the sheet: x right, y up.
/// The matrix is symmetric; all zero if no effect that is present answers to tension.
template <class Real>
struct Give {
  Real xx;  ///< [mm/N] in x by a force in x
  Real xy;  ///< [mm/N] in x by a force in y, and in y by a force in x
  Real yy;  ///< [mm/N] in y by a force in y
};

/// Answer of reach(): if the verdict is kCannotHang, all numbers are zero.
template <class Real>
struct Reached {
  Reach verdict;
  Real tension[kSideCount];  ///< [N] of each chain at its sprocket, where it pulls most
  Give<Real> give;
};

/// Whether a place `bit` [mm] is usable. Slow on the board.
template <class Real>
Reached<Real> reach(const Machine<Real>& machine, Point<Real> bit, const ReachLimits<Real>& limits);

/// [mm/N] in the direction in which the sled gives most: the larger root of the matrix.
template <class Real>
Real mostGive(const Give<Real>& give);

}  // namespace kinematics
