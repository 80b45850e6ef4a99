// Frame lean: on a leaning frame the chains droop down along the sheet and also towards it.
#pragma once

#include "../effect.h"

namespace kinematics {

/// On a frame that leans by an angle a, gravity along the sheet is reduced for sled and chain
/// alike, so their ratio and the sag along the sheet stay. Across the sheet the chain carries
/// w * sin(a), whatever its slope: tan(a) times the w * cos(a) of the frame's chain_weight. The two
/// droops are at right angles, so the squares of their loads add up: cosine^2 of ChainSag becomes
/// cosine^2 + tan(a)^2.
template <class Real>
struct FrameLean : Effect<Real> {
  enum { kTangentSquared, kParamCount };
  enum { kPerSlack, kCoefficientCount };
  enum { kNeedsForces = 1 };

  static EffectInfo info() {
    return {"frame_lean", "on a leaning frame the chains droop towards the sheet too",
            "like a tenth more of chain sag, and a little where chains are steep",
            "chain_sag, sled_swing",
            "measure the frame's angle from the vertical; enter its tangent squared"};
  }
  static ParamInfo param(uint8_t) {
    return {"tangent_squared",
            "1",
            0,
            0.2,
            0.072,
            "square of the tangent of the frame's angle from the vertical",
            0.005};
  }
  static const char* noun() { return "a leaning frame"; }
  static PlainInfo plain(uint8_t) {
    return {"frame leans # from the vertical", "", "degrees", 1, kAngle};
  }

  static CheckInfo check() {
    return {"the angle of the frame",
            "Measure how far the frame leans from the vertical, to half a degree, with a plumb "
            "line or an angle gauge.",
            "the tangent of that angle, squared (a plumb line: distance over height, squared)", 5};
  }
  static ReadingInfo reading(uint8_t) {
    return {"how far the frame leans", "degrees", 0.5, 1, 1, 0, kSquareOfTangent};
  }
  static Example example(uint8_t) { return {"leaning", {0.072}, 1}; }

  /// The frame's weights are the parts along the sheet; the judge needs the full weights.
  template <class Judge>
  static void setJudge(const Frame<Real>&, const Real* parameter, Judge& judge) {
    const Real whole = sqrt(Real(1) + parameter[kTangentSquared]);
    judge.set("lean", atan(sqrt(parameter[kTangentSquared])));
    judge.scale("sled_weight", whole);
    judge.scale("left.weight", whole);
    judge.scale("right.weight", whole);
  }

  static void prepare(const Frame<Real>& frame, const Real* parameter, Real* c) {
    const Real ratio = weightRatio(frame);
    c[kPerSlack] = parameter[kTangentSquared] * (ratio * ratio / Real(24));
  }

  PLUMB_RARE static void adjustLength(const Real* c, Strand<Real>& strand) {
    const Real slack = strand.free * strand.slack;
    strand.length += c[kPerSlack] * slack * slack * strand.free;
  }
};

}  // namespace kinematics
