// Chain sag: a chain that carries its own weight hangs in a curve and is longer than the straight
// line.
#pragma once

#include "../effect.h"

namespace kinematics {

/// Extra length of a shallow hanging chain that ends on a weightless arm.
///
/// The chain's weight across the line, per mm, is w * cosine; with tension T it bends at the
/// rate k = w * cosine / T. The curve starts at the sprocket with slope a, falls by k per mm over
/// the free length L, and goes on straight along the arm (no weight there). Closing on the bit, at
/// distance D = reach, asks for a = k L (1 - L / (2 D)). A curve is longer than its chord by half
/// the integral of its squared slope; that gives
///
///     extra = k^2 L^3 / 24 * (4 - 3 L / D).
///
/// With no arm (L = D) this is the textbook parabola, w^2 cosine^2 L^3 / (24 T^2). Written with
/// bend = W cosine / T, W the sled's weight, the machine's constants are one number,
/// weight_ratio_squared = w^2 / (24 W^2), which is the published chainSagCorrection / 1e12.
template <class Real>
struct ChainSag : Effect<Real> {
  enum { kWeightRatioSquared, kParamCount };
  enum { kPerCurl, kPerCurlAndLength, kLean, kLeanAndCurl, kCurl, kCoefficientCount };
  enum { kNeedsForces = 1 };

  static EffectInfo info() {
    return {"chain_sag",
            "the chain's own weight makes it hang in a curve, longer than a straight line",
            "lower corners move inward by millimetres and a little up; the middle column stays",
            "frame_lean, sled_friction, frame_flex",
            "weigh the sled and one metre of chain: the size follows from the two weights"};
  }
  static ParamInfo param(uint8_t) {
    return {"weight_ratio_squared",
            "1/mm^2",
            0,
            4e-11,
            8.2e-12,
            "(chain weight per mm / sled weight)^2 / 24; 1e12 times it is chainSagCorrection"};
  }

  static void prepare(const Frame<Real>& frame, const Real* parameter, Real* c) {
    const SagByLength<Real> sag = sagByLength(frame);
    c[kPerCurl] = parameter[kWeightRatioSquared] * sag.constant;
    c[kPerCurlAndLength] = parameter[kWeightRatioSquared] * sag.slope;
    const DeepSag<Real> deep = deepSagOf(frame);
    c[kLean] = deep.lean;
    c[kLeanAndCurl] = deep.lean_and_curl;
    c[kCurl] = deep.curl;
  }

  static void adjustLength(const Real* c, Strand<Real>& strand) {
    const Real curl = strand.bend * strand.free;
    Real extra = curl * curl * (c[kPerCurl] + c[kPerCurlAndLength] * strand.free);
    if (strand.deep) {
      const Real lean = strand.lean * strand.free;
      extra += extra * (strand.ease + lean * (c[kLean] + c[kLeanAndCurl] * curl) + c[kCurl] * curl);
    }
    strand.length += extra;
  }
};

}  // namespace kinematics
