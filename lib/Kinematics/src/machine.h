// A machine ready for computing: everything that depends only on settings, worked out once.
#pragma once

#include "effects.h"
#include "wrap.h"

namespace kinematics {

/// One value for each effect parameter, in the registry's order; all zero: no effect at all.
template <class Real>
struct EffectParams {
  Real value[kEffectParamCount];

  /// Sets the parameter with that $-setting; false if there is none.
  bool set(int setting, Real size) {
    const int index = Effects::For<Real>::indexOf(setting);
    if (index >= 0) value[index] = size;
    return index >= 0;
  }
};

/// Settings turned into the constants that inverse() and forward() read. prepare() makes it.
/// The fields that every call reads come first: the board reaches the first 63 bytes fastest.
template <class Real>
struct Machine {
  Point<Real> sprocket[kSideCount];  ///< [mm] centres
  Real radius_squared;               ///< [mm^2] of the sprocket
  Real rotation_radius;              ///< [mm] as in the frame
  Real feed_radius;                  ///< [mm] sprocket's, negative off the bottom
  Wrap<Real> wrap;                   ///< by kArc in Kinematics.cpp
  Real load_at_nothing;              ///< [1] load / sled weight where both chains have no length
  Real load_slope;   ///< [1/mm] growth of load / sled weight with both chains' length
  Real ease;         ///< [1/mm^2] see easeOf in deep.h
  bool deep;         ///< the second order of sag counts
  bool level;        ///< both sprockets are equally high
  bool forces;       ///< some present effect asks for tensions
  uint16_t present;  ///< a bit for each effect whose parameters are not all zero
  Real coefficient[kEffectCoefficientCount];
  Real highest, lowest, leftmost, rightmost;  ///< [mm] between these a sled can hang
  Frame<Real> frame;
};

}  // namespace kinematics
