// How much chain lies on a sprocket's teeth, worked out without an arc function.
#pragma once

#include "strand.h"

namespace kinematics {

/// Chain from 12 o'clock to the tangent point of a line with sine s and cosine c below the
/// horizontal: radius * angle, and angle = pi/4 + asin((s - c) / sqrt(2)), by odd powers of s - c.
template <class Real>
struct Wrap {
  Real middle;                 ///< [mm] for a chain at 45 degrees
  Real slope, cubic, quintic;  ///< [mm] by powers of sine less cosine

  Real at(Real u) const {
    const Real v = u * u;
    return middle + u * (slope + v * (cubic + v * quintic));
  }
};

/// [mm] The sprocket's radius; negative off the bottom, where the geometry is mirrored.
template <class Real>
Real feedRadius(const Frame<Real>& frame) {
  return frame.feed == Feed::kOverTop ? frame.sprocket_radius : -frame.sprocket_radius;
}

/// The wrap by three coefficients of the arc. Off the bottom the chain first goes half way round
/// the sprocket.
template <class Real>
Wrap<Real> wrapOf(const Frame<Real>& frame, const double* arc) {
  const double kQuarterPi = 0.78539816339744831, kPi = 3.14159265358979324;
  const Real radius = feedRadius(frame);
  Wrap<Real> wrap = {radius * Real(kQuarterPi), radius * Real(arc[0]), radius * Real(arc[1]),
                     radius * Real(arc[2])};
  if (frame.feed != Feed::kOverTop) wrap.middle += frame.sprocket_radius * Real(kPi);
  return wrap;
}

}  // namespace kinematics
