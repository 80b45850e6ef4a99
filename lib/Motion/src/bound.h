// How long a segment may be: an upper bound for the error of a quadratic through three knots.
#pragma once

#include <math.h>

#include "path.h"

namespace motion {

/// Upper bounds, in any direction, for the slopes of what physics adds to the straight distance
/// from sprocket to bit: wrap, sag, stretch. All zero: the distance alone.
template <class Real>
struct Slopes {
  Real first;   ///< [1]
  Real second;  ///< [1/mm]
  Real third;   ///< [1/mm^2]
};

/// Features of a path that the bound depends on.
template <class Real>
struct Surroundings {
  Real nearest;          ///< [mm] least distance of the path from either sprocket's centre
  Slopes<Real> effects;  ///< bounds for either chain's length less its distance
};

// Largest error of the quadratic. With the rounding of the float inverse and of float places a
// set-point stays within 0.003 mm of the exact length, and each step within 0.0015 mm.
const float kMostMissed = 0.001f;  // [mm]
// Covers arcs whose radius changes by kMostOffArc, even small arcs.
const float kSpiralMargin = 1.15f;

/// Upper bound [1/mm^2] for the third slope of a chain's length along a path.
///
/// For the distance d to a sprocket on a path of curvature k, at angle a between path and ray:
///     d'   = cos a                   a' = k - sin(a) / d
///     d''' = -cos a * (k^2 - 3 k sin(a) / d + 3 sin(a)^2 / d^2)
/// and |sin a cos a| <= 1/2, |sin(a)^2 cos a| <= 2 / (3 sqrt 3). What effects add changes with
/// their three slopes and with the path's curvature, as any function of the place does.
template <class Real>
Real thirdSlope(Real curvature, const Surroundings<Real>& around) {
  const Real per_distance = Real(1) / around.nearest;
  const Slopes<Real>& effects = around.effects;
  const Real straight = Real(1.1547) * per_distance * per_distance + effects.third;
  const Real turning = Real(1.5) * per_distance + Real(3) * effects.second;
  const Real bent = straight + curvature * (turning + curvature * (Real(1) + effects.first));
  return curvature == Real(0) ? bent : bent * Real(kSpiralMargin);
}

/// Upper bound [1/mm] for the second slope of a chain's length along a path. For the distance,
///     d'' = -k sin a + sin(a)^2 / d
template <class Real>
Real secondSlope(Real curvature, const Surroundings<Real>& around) {
  const Slopes<Real>& effects = around.effects;
  return curvature * (Real(1) + effects.first) + Real(1) / around.nearest + effects.second;
}

/// Longest time h, in the unit of speed and acceleration, in which a quadratic of time through both
/// ends and the middle misses no more than kMostMissed. The acceleration along the path is
/// constant, so for a length L at a place s(t)
///     L''' = L'''(s) speed^3 + 3 L''(s) speed acceleration.
/// The quadratic misses at most (third slope) / 6 * (t - 0)(t - h/2)(t - h). That product is at
/// most (h/2)^3 * 2 / (3 sqrt 3), so the error is at most third slope * h^3 / (72 sqrt 3).
template <class Real>
Real longestTime(Real third_slope, Real second_slope, Real speed, Real acceleration) {
  const Real along = third_slope * speed * speed + Real(3) * second_slope * acceleration;
  return cbrt(Real(124.7077) * Real(kMostMissed) / (along * speed));
}

/// Upper bounds for the slopes of a length [mm] that grows as (far_run * drop / near_run)^2 / span:
/// a chain's sag. All four sizes [mm] are those of the place where the sag is largest, the lower
/// corner under the other motor.
///
/// Along any line, u^p grows no faster than (1 - s / u)^-|p|. Let l1, l2, l3 be the sums of
/// |p| / u, |p| / u^2, |p| / u^3. Then the slopes are at most l1, l1^2 + l2 and
/// l1^3 + 3 l1 l2 + 2 l3 times the length.
template <class Real>
Slopes<Real> sagSlopes(Real sag, Real far_run, Real near_run, Real drop, Real span) {
  const Real u[] = {far_run, near_run, drop, span};
  const Real power[] = {Real(2), Real(2), Real(2), Real(1)};
  Real l1 = Real(0), l2 = Real(0), l3 = Real(0);
  for (int i = 0; i < 4; ++i) {
    const Real per = Real(1) / u[i];
    l1 += power[i] * per;
    l2 += power[i] * per * per;
    l3 += power[i] * per * per * per;
  }
  return {sag * l1, sag * (l1 * l1 + l2), sag * (l1 * l1 * l1 + Real(3) * l1 * l2 + Real(2) * l3)};
}

}  // namespace motion
