// Chain zero: when a sprocket's count was set, more or less chain was out than that count says.
#pragma once

#include "../effect.h"

namespace kinematics {

/// The motor pays out the chain that is needed less the chain that was already out at 12 o'clock.
///
/// The same error on both sides acts exactly like a wrong rotation_radius. A skipped tooth is an
/// error of a pitch, 6.35 mm.
template <class Real>
struct ChainZero : Effect<Real> {
  enum { kLeftOut, kRightOut, kParamCount };
  enum { kCoefficientCount = kSideCount };
  enum { kPerZeroing = 1 };
  enum { kInFrame = 1 };  // a moved frame looks the same
  enum { kExampleCount = 2 };

  static EffectInfo info() {
    return {"chain_zero", "a chain was not at its mark when its sprocket's count was set",
            "the whole job moves and turns; a skipped tooth moves it by centimetres",
            "rotation_radius, motor_gap, sheet_rotation",
            "bring both sprockets back to 12 o'clock and look whether the marked links are there"};
  }
  static ParamInfo param(uint8_t i) {
    if (i == kLeftOut) return {"left", "mm", -30, 30, 2, "left chain out at 12 o'clock", 1};
    return {"right", "mm", -30, 30, 2, "right chain out at 12 o'clock", 1};
  }
  static const char* noun() { return "chains that were not zeroed right"; }
  static PlainInfo plain(uint8_t i) {
    if (i == kLeftOut)
      return {"left chain out # too far at zero", "left chain out # too little at zero", "mm"};
    return {"right chain out # too far at zero", "right chain out # too little at zero", "mm"};
  }

  static CheckInfo check() {
    return {"both chains at 12 o'clock",
            "Send both chains to the length that the machine calls zero and measure how far the "
            "marked links are past 12 o'clock, to {1 mm|0.039 inch}.",
            "mm of chain that are out at 12 o'clock", 8};
  }
  static ReadingInfo reading(uint8_t i) {
    const char* const title = i == kLeftOut ? "how far the left chain is out at 12 o'clock"
                                            : "how far the right chain is out at 12 o'clock";
    return {title, "mm", 1, 1};
  }
  static Example example(uint8_t i) {
    static const Example kExamples[] = {{"one each way", {2, -1}, 20}, {"both alike", {2, 2}, 20}};
    return kExamples[i];
  }
  template <class Judge>
  static void setJudge(const Frame<Real>&, const Real* parameter, Judge& judge) {
    judge.set("left.zero", parameter[kLeftOut]);
    judge.set("right.zero", parameter[kRightOut]);
  }

  /// The published formula divides the arm as well as the chain, so its length falls short of ours.
  static void addPublished(const Frame<Real>& frame, const PublishedChains<Real>& published,
                           Real* parameter) {
    for (uint8_t i = 0; i < kParamCount; ++i)
      parameter[i] += frame.rotation_radius * published.strain[i] / (Real(1) + published.strain[i]);
  }

  static void prepare(const Frame<Real>&, const Real* parameter, Real* c) {
    for (uint8_t i = 0; i < kParamCount; ++i) c[i] = parameter[i];
  }

  PLUMB_RARE static void adjustLength(const Real* c, Strand<Real, false>& strand) {
    strand.length -= c[strand.side];
  }
};

}  // namespace kinematics
