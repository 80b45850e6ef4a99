// Chain lengths as whole counts: the numbers in set-points.
#pragma once

#include <math.h>
#include <stdint.h>

#include "point.h"

namespace motion {

// A count is 2^-16 mm = 0.000015 mm, so the upper two bytes of an int32 are whole mm. Lengths stay
// within 2^13 mm = 8192 mm, that is 2^29 counts. The rest of the 31 bits is room for the sums in
// segment.h.
const int32_t kCountsPerMm = 65536;
const float kLongestChain = 8191;  // [mm]

/// Both chains' lengths at the same moment.
struct Knot {
  int32_t left, right;  ///< [counts] paid out
};

/// The exact inverse's answer, in counts.
struct Reached {
  Knot knot;
  bool reachable;  ///< false: refused, NaN, or too long for counts
};

/// Counts for a length [mm], to the nearest.
template <class Real>
int32_t toCounts(Real length) {
  return int32_t(lround(length * Real(kCountsPerMm)));
}

/// Length [mm] of counts.
template <class Real>
Real toMm(int32_t counts) {
  return Real(counts) / Real(kCountsPerMm);
}

/// The exact lengths for a place [mm] from `inverse`: Point<Real> -> Lengths<Real>.
template <class Real, class Inverse>
Reached knotAt(const Inverse& inverse, Point<Real> place) {
  const Lengths<Real> exact = inverse(place);
  // Written so that a NaN is refused.
  if (exact.reachable && fabs(exact.left) < Real(kLongestChain) &&
      fabs(exact.right) < Real(kLongestChain))
    return {{toCounts(exact.left), toCounts(exact.right)}, true};
  return {{0, 0}, false};
}

}  // namespace motion
