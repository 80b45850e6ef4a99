// How long a segment may be: a bound on what a quadratic through three knots misses.
#pragma once

#include <math.h>

#include "path.h"

namespace motion {

/// Slopes, at most and in any direction, of what physics adds to the straight distance from
/// sprocket to bit: wrap, sag, stretch. All zero: the distance alone.
template <class Real>
struct Slopes {
  Real first;   ///< [1]
  Real second;  ///< [1/mm]
  Real third;   ///< [1/mm^2]
};

/// Where a path runs, as far as the bound asks.
template <class Real>
struct Surroundings {
  Real nearest;          ///< [mm] to either sprocket's centre from anywhere on the path, at least
  Slopes<Real> effects;  ///< of either chain's length less that distance, at most
};

// What the quadratic may miss. With the float inverse and float places a set-point then stays
// within 0.003 mm, and a step of it within 0.0015 mm: what misses by e jitters by e.
const float kMostMissed = 0.001f;  // [mm]
// Covers arcs whose radius changes by kMostOffArc, small ones too.
const float kSpiralMargin = 1.15f;

/// Third slope [1/mm^2] of a chain's length along a path, at most.
///
/// Of the distance d to a sprocket on a path of curvature k, at angle a between path and ray:
///     d'   = cos a                   a' = k - sin(a) / d
///     d''' = -cos a * (k^2 - 3 k sin(a) / d + 3 sin(a)^2 / d^2)
/// and |sin a cos a| <= 1/2, |sin(a)^2 cos a| <= 2 / (3 sqrt 3). What effects add changes by their
/// own three slopes and by the path's turning, as any function of the place does.
template <class Real>
Real thirdSlope(Real curvature, const Surroundings<Real>& around) {
  const Real per_distance = Real(1) / around.nearest;
  const Slopes<Real>& effects = around.effects;
  const Real straight = Real(1.1547) * per_distance * per_distance + effects.third;
  const Real turning = Real(1.5) * per_distance + Real(3) * effects.second;
  const Real bent = straight + curvature * (turning + curvature * (Real(1) + effects.first));
  return curvature == Real(0) ? bent : bent * Real(kSpiralMargin);
}

/// Second slope [1/mm] of a chain's length along a path, at most: of the distance
///     d'' = -k sin a + sin(a)^2 / d
template <class Real>
Real secondSlope(Real curvature, const Surroundings<Real>& around) {
  const Slopes<Real>& effects = around.effects;
  return curvature * (Real(1) + effects.first) + Real(1) / around.nearest + effects.second;
}

/// Longest time, in the unit of speed and acceleration, in which a quadratic of time through both
/// ends and the middle misses no more than kMostMissed, where a path is walked evenly faster or
/// slower: of a length L at a place s(t)
///     L''' = L'''(s) speed^3 + 3 L''(s) speed acceleration
/// A quadratic misses at most (third slope) / 6 * (t - 0)(t - h/2)(t - h), whose product is at most
/// (h/2)^3 * 2 / (3 sqrt 3): together third slope * h^3 / (72 sqrt 3).
template <class Real>
Real longestTime(Real third_slope, Real second_slope, Real speed, Real acceleration) {
  const Real along = third_slope * speed * speed + Real(3) * second_slope * acceleration;
  return cbrt(Real(124.7077) * Real(kMostMissed) / (along * speed));
}

/// Slopes, at most, of a length [mm] that grows as (far_run * drop / near_run)^2 / span: a chain's
/// sag. All four [mm] are taken where it is largest, in the lower corner under the other motor.
///
/// Along any line, u^p grows no faster than (1 - s / u)^-|p|. So with l1, l2, l3 the sums of
/// |p| / u, |p| / u^2, |p| / u^3, the slopes are at most l1, l1^2 + l2 and l1^3 + 3 l1 l2 + 2 l3
/// times the length.
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
