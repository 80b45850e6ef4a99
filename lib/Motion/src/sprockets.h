// Where the sprockets are, and what follows for the chains along a path.
#pragma once

#include "bound.h"

namespace motion {

/// Both sprockets' centres [mm], and what effects add to the chains.
template <class Real>
struct Sprockets {
  Point<Real> left, right;
  Slopes<Real> effects;  ///< bounds for either chain's length less its distance
};

/// Features of a path that the bound for segments depends on.
template <class Real>
Surroundings<Real> surroundingsOf(const Path<Real>& path, const Sprockets<Real>& sprockets) {
  const Real left = clearance(path, sprockets.left), right = clearance(path, sprockets.right);
  const Real nearest = left < right ? left : right;
  // Near a sprocket there is no bound; the exact inverse refuses such a path anyway.
  return {nearest > Real(1) ? nearest : Real(1), sprockets.effects};
}

namespace sprockets_detail {

/// Absolute cosine between a direction and the ray from a sprocket to a place.
template <class Real>
Real cosineAt(Point<Real> place, Point<Real> sprocket, Point<Real> direction) {
  const Real x = place.x - sprocket.x, y = place.y - sprocket.y;
  const Real distance = Real(sqrt(x * x + y * y));
  if (!(distance > Real(0))) return Real(1);
  return Real(fabs(x * direction.x + y * direction.y)) / distance;
}

}  // namespace sprockets_detail

/// Upper bound [1] for the chain paid out or wound in, over the way along a path.
///
/// Along a line the cosine between line and ray only grows (d'' = sin(a)^2 / d), so its absolute
/// value is largest at an end. For an arc it is taken as 1.
template <class Real>
Real steepest(const Path<Real>& path, const Sprockets<Real>& sprockets) {
  using sprockets_detail::cosineAt;
  if (path.sweep != Real(0)) return Real(1) + sprockets.effects.first;
  const Point<Real> along = {(path.to.x - path.from.x) / path.length,
                             (path.to.y - path.from.y) / path.length};
  const Real cosines[] = {
      cosineAt(path.from, sprockets.left, along), cosineAt(path.to, sprockets.left, along),
      cosineAt(path.from, sprockets.right, along), cosineAt(path.to, sprockets.right, along)};
  Real most = Real(0);
  for (int i = 0; i < 4; ++i)
    if (cosines[i] > most) most = cosines[i];
  return most + sprockets.effects.first;
}

}  // namespace motion
