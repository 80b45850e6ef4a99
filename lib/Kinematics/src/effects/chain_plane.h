// Chain plane: sprockets and ring are at different distances from the sheet, so the chains slant.
#pragma once

#include <math.h>

#include "../effect.h"

namespace kinematics {

/// A chain of length L along the sheet whose ends differ by g across it is sqrt(L^2 + g^2) long.
/// Only the chain slants; the ring stays in its plane.
template <class Real>
struct ChainPlane : Effect<Real> {
  enum { kGapSquared, kParamCount };
  enum { kAcross, kCoefficientCount };

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
            "square of the difference in distance from the sheet, sprockets against ring",
            250};
  }
  static const char* noun() { return "chains that are not parallel to the sheet"; }
  static PlainInfo plain(uint8_t) {
    return {"sprockets and ring differ by # in their distance from the sheet", "", "mm", 1, kRoot};
  }

  static CheckInfo check() {
    return {"a ruler at sprocket and ring",
            "Measure how far sprockets and ring stand off the sheet, to {3 mm|0.12 inch}.",
            "the difference of both, squared", 6};
  }
  static ReadingInfo reading(uint8_t) {
    return {"how much farther from the sheet the sprockets are than the ring",
            "mm",
            3,
            1,
            1,
            0,
            kSquare};
  }
  static Example example(uint8_t) { return {"sprockets off the sheet", {1600}, 20}; }
  template <class Judge>
  static void setJudge(const Frame<Real>&, const Real* parameter, Judge& judge) {
    judge.set("plane_gap", sqrt(parameter[kGapSquared]));
  }

  static void prepare(const Frame<Real>&, const Real* parameter, Real* c) {
    c[kAcross] = parameter[kGapSquared];
  }

  PLUMB_RARE static void adjustLength(const Real* c, Strand<Real, false>& strand) {
    strand.length += sqrt(strand.free * strand.free + c[kAcross]) - strand.free;
  }
};

}  // namespace kinematics
