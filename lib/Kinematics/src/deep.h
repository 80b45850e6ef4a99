// Deep chains: the second order of sag, for light sleds and unusual rings; constants only.
#pragma once

#include "wrap.h"

namespace kinematics {

// The closed form of sag is the first term of a series in the chain's weight over its tension. On
// usual machines the next terms nearly cancel (0.004 mm of chain). Under a light sled, with a much
// wider or narrower ring, or with motors high above the sheet they do not cancel (0.2 mm).
//
// The terms follow from the exact hanging chain. With q = w cosine L / T and t = tan(angle):
//  - ease: a chain that bends pulls less, because its weight acts nearer to the sprocket, by
//    q t / 6 and more with an arm. Both strands share the loss of pull.
//  - lean: the arm, and so the chord, turns with the chain's end.
//  - curl: chain leaves the sprocket earlier by radius * q / 2, so less of it hangs.
//  - lean_and_curl: the fourth order of the catenary, with the slope squared.
// The five numbers below were fitted to exact catenaries over 240 machines: gap 2.9 to 3.7 m,
// offset 463 and 700 mm, sled 60 to 150 N, ring 0 to 250 mm, both feeds. 0.0052 mm remain.
const float kEase = 0.0661f, kEaseByArm = 1.7121f;
const float kLeanByArm = -0.1213f, kLeanByArmSquared = -2.99f;
const float kLeanAndCurl = 0.0566f;
const float kCurl = -0.8485f;

// A chain is about this long where it sags most. The arm's share at this length serves everywhere.
const float kLongChain = 0.84f;  // [1] of the gap

// Beyond these limits the first order misses more than 0.005 mm somewhere on the sheet.
const float kNarrowRing = 120, kWideRing = 160;  // [mm]
const float kDeepWeight = 1.45e-5f;              // [1/mm] chain weight per mm / sled weight
const float kHighMotors = 0.42f;                 // [1] motor_height / gap

template <class Real>
Real weightRatio(const Frame<Real>& frame) {
  return frame.chain_weight / frame.sled_weight;
}

template <class Real>
Real armShare(const Frame<Real>& frame) {
  return frame.rotation_radius / (Real(kLongChain) * frame.motor_gap);
}

/// L (4 - 3 L / D), the length by which sag grows, as constant + slope * L [mm].
///
/// With R the arm it is D + 2 R - 3 R^2 / D: nearly a straight line over the lengths at which a
/// chain sags at all. The answer is the tangent of that curve at a long chain's D.
template <class Real>
struct SagByLength {
  Real constant, slope;
};

template <class Real>
SagByLength<Real> sagByLength(const Frame<Real>& frame) {
  const Real arm = armShare(frame);
  const Real slope = Real(1) + Real(3) * arm * arm;
  return {frame.rotation_radius * (Real(2) + slope - Real(6) * arm), slope};
}

/// Whether a machine needs the second order.
template <class Real>
bool isDeep(const Frame<Real>& frame) {
  return weightRatio(frame) > Real(kDeepWeight) || frame.rotation_radius < Real(kNarrowRing) ||
         frame.rotation_radius > Real(kWideRing) ||
         frame.motor_height > Real(kHighMotors) * frame.motor_gap;
}

/// [1/mm^2] Times both strands' free^2 * lean, the share by which sag grows as chains pull less.
template <class Real>
Real easeOf(const Frame<Real>& frame) {
  const Real ratio = weightRatio(frame);
  return ratio * ratio * (Real(kEase) + Real(kEaseByArm) * armShare(frame));
}

/// Additions to the sag by the shape of a strand, as shares of the sag.
template <class Real>
struct DeepSag {
  Real lean;           ///< [1/mm] times lean * free
  Real lean_and_curl;  ///< [1/mm^2] times lean * free * bend * free
  Real curl;           ///< [1/mm] times bend * free
};

template <class Real>
DeepSag<Real> deepSagOf(const Frame<Real>& frame) {
  const Real ratio = weightRatio(frame);
  const Real arm = armShare(frame);
  const Real radius = feedRadius(frame);
  return {ratio * arm * (Real(kLeanByArm) + Real(kLeanByArmSquared) * arm),
          ratio * ratio * Real(kLeanAndCurl), ratio * (radius / frame.motor_gap) * Real(kCurl)};
}

}  // namespace kinematics
