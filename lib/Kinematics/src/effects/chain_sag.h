// Chain sag: a chain that carries its weight hangs in a curve and is longer than the straight line.
#pragma once

#include "../effect.h"

namespace kinematics {

/// Extra length of a shallow hanging chain that ends on a weightless arm.
///
/// The chain's weight across the line is w * cosine per mm. With tension T the chain bends at the
/// rate k = w * cosine / T. The curve starts at the sprocket with slope a. The slope falls by k per
/// mm over the free length L and stays as it is along the arm, which has no weight. The curve must
/// end at the bit, at distance D = reach, so a = k L (1 - L / (2 D)). A curve is longer than its
/// chord by half the integral of its squared slope:
///
///     extra = k^2 L^3 / 24 * (4 - 3 L / D).
///
/// With no arm (L = D) this is the textbook parabola, w^2 cosine^2 L^3 / (24 T^2). With
/// bend = W cosine / T, where W is the sled's weight, a single number holds the machine's
/// constants: weight_ratio_squared = w^2 / (24 W^2), the published chainSagCorrection / 1e12.
template <class Real>
struct ChainSag : Effect<Real> {
  enum { kWeightRatioSquared, kParamCount };
  enum { kPerCurl, kPerCurlAndLength, kLean, kLeanAndCurl, kCurl, kCoefficientCount };
  enum { kNeedsForces = 1, kBends = 1 };
  enum { kWeightPower = -2 };

  static EffectInfo info() {
    return {"chain_sag", "the chain's weight makes it hang in a curve, longer than a straight line",
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
            "(chain weight per mm / sled weight)^2 / 24; 1e12 times it is chainSagCorrection",
            4e-13};
  }
  static const char* noun() { return "chain sag"; }
  static PlainInfo plain(uint8_t) {
    return {"chains sag # the usual amount", "", "times", 1 / 8.2e-12};
  }

  static CheckInfo check() {
    return {"sled and chain on a scale",
            "Weigh the sled with router and bricks to 0.2 kg, and {3 m|118 1/8 inches} of chain "
            "to 10 g.",
            "(kg of one mm of chain / kg of the sled) squared, / 24", 12};
  }
  /// 3 m of chain: grams / 1000 / 3000 mm * 9.81 N/kg, over the sled's weight.
  static ReadingInfo reading(uint8_t) {
    const double a_mm = 9.81 / 1000 / 3000;  // [N]
    return {"{3 m|118 1/8 inches} of chain on a scale", "g", 10, a_mm * a_mm / 24, 0, 0, kSquare};
  }
  static double usual(const Frame<Real>& frame, uint8_t) {
    const double ratio = double(weightRatio(frame));
    return ratio * ratio / 24;
  }
  static Example example(uint8_t) { return {"heavier chain", {8.194456696256386e-12}, 20}; }
  template <class Judge>
  static void setJudge(const Frame<Real>& frame, const Real* parameter, Judge& judge) {
    const Real heavier = sqrt(parameter[kWeightRatioSquared] / Real(usual(frame, 0)));
    judge.scale("left.weight", heavier);
    judge.scale("right.weight", heavier);
  }

  static PublishedInfo published(uint8_t) { return {37, 1e12}; }

  /// The published sag exceeds ours, because it takes the arm for chain. With u the arm's share of
  /// the line, the ratio is line^3 to chain^3 (1 + 3 u). It is taken at the longest line on the
  /// sheet, where nearly all sag is.
  static void addPublished(const Frame<Real>& frame, const PublishedChains<Real>& published,
                           Real* parameter) {
    if (published.sag_correction == Real(0)) return;
    const Real across = Real(0.5) * (frame.motor_gap + published.sheet_width);
    const Real down = frame.motor_height + Real(0.5) * published.sheet_height;
    const Real share = frame.rotation_radius / sqrt(across * across + down * down);
    const Real chain = Real(1) - share;
    parameter[kWeightRatioSquared] +=
        published.sag_correction *
        (Real(1) / (chain * chain * chain * (Real(1) + Real(3) * share)));
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
