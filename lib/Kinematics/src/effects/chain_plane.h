// Chain plane: sprockets and ring lie at different distances from the sheet, so chains run
// slanting.
#pragma once

#include "../effect.h"

namespace kinematics {

/// A chain of length L along the sheet whose ends differ by g across it is sqrt(L^2 + g^2) long:
/// longer by g^2 / (2 L). Only the chain slants, the ring keeps its plane. The next order,
/// g^4 / (8 L^3), is 0.005 mm at 40 mm across and 0.4 m of chain.
template <class Real>
struct ChainPlane : Effect<Real> {
  enum { kGapSquared, kParamCount };
  enum { kHalfGapSquared, kCoefficientCount };

  static EffectInfo info() {
    return {"chain_plane", "the chains do not run parallel to the sheet",
            "the top rises, most in the middle; x hardly moves", "chain_stretch, frame_flex",
            "measure with a ruler how far sprockets and ring stand off the sheet"};
  }
  static ParamInfo param(uint8_t) {
    return {"gap_squared",
            "mm^2",
            0,
            22500,
            1600,
            "square of the difference in distance from the sheet, sprockets against ring"};
  }

  static void prepare(const Frame<Real>&, const Real* parameter, Real* c) {
    c[kHalfGapSquared] = parameter[kGapSquared] * Real(0.5);
  }

  PLUMB_RARE static void adjustLength(const Real* c, Strand<Real>& strand) {
    strand.length += c[kHalfGapSquared] / strand.free;
  }
};

}  // namespace kinematics
