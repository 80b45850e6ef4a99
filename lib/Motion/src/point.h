// A place on the sheet, and what is known of a chain's length there.
#pragma once

namespace motion {

/// A place on the sheet; the origin is the sheet's middle, x to the right, y up.
template <class Real>
struct Point {
  Real x, y;  ///< [mm]
};

/// Answer of the exact inverse, which is passed in as a callable, for a place.
template <class Real>
struct Lengths {
  Real left, right;  ///< [mm] paid out
  bool reachable;    ///< false: no sled can hang there; do not use the lengths
};

}  // namespace motion
