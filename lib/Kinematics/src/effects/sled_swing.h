// Sled swing: the bit is off the ring's centre while the sled turns with its chains.
#pragma once

#include <math.h>

#include "../effect.h"

namespace kinematics {

/// A sled that turns with its chains, by half the difference f of their angles, carries its bit
/// around the point where the chains meet. On the upright sled the bit is `right` and `up` of that
/// point. On the turned sled the point is at bit - R(f) (right, up). Compared with the upright sled
/// the point has moved by
///     m = (right, up) - R(f) (right, up).
/// (The offset of an upright sled moves all marks alike: it belongs to the sheet's position.)
///
/// cos(2f) and sin(2f) come from the straight strands' directions, and a square root gives the half
/// angle. Then f is corrected, because the hanging chains end flatter than the straight lines: by
/// their curvature (w / W) bend over half their length. The arm's share of that length is taken at
/// a long chain.
template <class Real>
struct SledSwing : Effect<Real> {
  enum { kBitRight, kBitUp, kParamCount };
  enum { kEndTurn = kParamCount, kCoefficientCount };
  enum { kNeedsForces = 1, kMovesEnds = 1 };  // forces for the directions
  enum { kExampleCount = 3 };
  enum { kChainMicrometres = 12, kBitMicrometres = 20 };

  static EffectInfo info() {
    return {
        "sled_swing", "the bit is off the ring's centre while the sled turns with the chains",
        "marks at the sides move against those in the middle, up on one side, down on the other",
        "chain_pitch, sheet_skew, tape_scale",
        "turn the sled by hand on its ring and see whether the bit draws a circle"};
  }
  static ParamInfo param(uint8_t i) {
    if (i == kBitRight) return {"right", "mm", -10, 10, 2, "bit right of the ring's centre", 0.3};
    return {"up", "mm", -10, 10, 2, "bit above the ring's centre", 0.3};
  }
  static const char* noun() { return "a bit off the ring's centre"; }
  static PlainInfo plain(uint8_t i) {
    if (i == kBitRight)
      return {"bit # right of the ring's centre", "bit # left of the ring's centre", "mm"};
    return {"bit # above the ring's centre", "bit # below the ring's centre", "mm"};
  }

  static CheckInfo check() {
    return {"the sled turned on its ring",
            "Turn the sled by hand on its ring and look how the bit wanders: it is off the ring's "
            "centre by half the circle that it draws. Measure to {0.3 mm|0.012 inch}.",
            "mm that the bit is right of, and above, the ring's centre on the upright sled", 12};
  }
  static ReadingInfo reading(uint8_t i) {
    const char* const title = i == kBitRight ? "how far the bit is right of the ring's centre"
                                             : "how far the bit is above the ring's centre";
    return {title, "mm", 0.3, 1};
  }
  static Example example(uint8_t i) {
    static const Example kExamples[] = {
        {"right and up", {2, 2}, 8}, {"right", {2, 0}, 4}, {"up", {0, 2}, 4}};
    return kExamples[i];
  }
  template <class Judge>
  static void setJudge(const Frame<Real>&, const Real* parameter, Judge& judge) {
    judge.set("bit_right", parameter[kBitRight]);
    judge.set("bit_up", parameter[kBitUp]);
  }

  static void prepare(const Frame<Real>& frame, const Real* parameter, Real* c) {
    c[kBitRight] = parameter[kBitRight];
    c[kBitUp] = parameter[kBitUp];
    // Half the length over which the chain curves, and half the difference of both ends: a quarter.
    c[kEndTurn] = weightRatio(frame) * (Real(1) - armShare(frame)) * Real(0.25);
  }

  template <class SomeForces>
  PLUMB_RARE static void moveEnds(const Real* c, const Strand<Real>* strand,
                                  const SomeForces& forces, Point<Real>* span) {
    const Strand<Real>& left = strand[kLeft];
    const Strand<Real>& right = strand[kRight];
    const Real twice = left.cosine * right.cosine + left.sine * right.sine;
    const Real half = sqrt((Real(1) + twice) * Real(0.5));
    const Real half_sine = (right.sine * left.cosine - right.cosine * left.sine) / (half + half);
    const Real flatter =
        c[kEndTurn] * forces.differencePerLevel(left.cosine * left.cosine * left.free,
                                                right.cosine * right.cosine * right.free);
    const Real sine = half_sine - half * flatter;
    // [1] by which the cosine is below that of an upright sled
    const Real less = Real(1) - half - half_sine * flatter;
    const Real x = less * c[kBitRight] + sine * c[kBitUp];
    const Real y = less * c[kBitUp] - sine * c[kBitRight];
    span[kLeft].x += x;
    span[kRight].x -= x;
    span[kLeft].y -= y;
    span[kRight].y -= y;
  }
};

}  // namespace kinematics
