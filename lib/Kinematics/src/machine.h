// A machine made ready for computing: what depends on settings alone is worked out once.
#pragma once

#include "effects.h"

namespace kinematics {

/// One value for each effect parameter, in the registry's order; all zero: no effect at all.
template <class Real>
struct EffectParams {
  Real value[kEffectParamCount];
};

/// Constants of one sprocket.
template <class Real>
struct Sprocket {
  Point<Real> center;  ///< [mm]
};

/// Settings turned into the constants that inverse() and forward() read. Made by prepare().
template <class Real>
struct Machine {
  Frame<Real> frame;
  Sprocket<Real> sprocket[kSideCount];
  Real feed_radius;          ///< [mm] sprocket_radius, negative for chain off the bottom
  Real half_radius_squared;  ///< [mm^2] sprocket_radius^2 / 2
  Real wrap_middle;          ///< [mm] wrap towards a bit 45 degrees below the sprocket
  Real wrap_less_arm;        ///< [mm] wrap_middle - rotation_radius
  Real wrap_slope[3];        ///< [mm] odd coefficients of the wrap, see kArc
  Real half_weight_ratio;    ///< [1/mm] chain weight per mm / sled weight / 2
  Real coefficient[kEffectParamCount];
  uint16_t present;  ///< a bit for each effect that is not zero
  bool forces;       ///< some present effect asks for tensions
};

}  // namespace kinematics
