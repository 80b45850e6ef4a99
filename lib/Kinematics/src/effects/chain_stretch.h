// Chain stretch: steel and pin joints give under load, so fewer links reach the same distance.
#pragma once

#include "../effect.h"

namespace kinematics {

/// Loaded free chain of length L measures links * (1 + compliance * tension).
///
/// The code solves this for the links to second order. The second order is 0.0014 mm of chain
/// under low motors, where 1 mm of both chains is 4 mm at the bit. Chain on the sprocket does not
/// count: each link sits on its tooth, whatever it carries.
template <class Real>
struct ChainStretch : Effect<Real> {
  enum { kCompliance, kParamCount };
  enum { kPerPull, kCoefficientCount };
  enum { kNeedsForces = 1, kBends = 1 };
  enum { kClientNumber = 45 };  // chainElasticity of WebControl

  static EffectInfo info() {
    return {"chain_stretch", "the loaded chain is longer than its links were when slack",
            "top centre drops by millimetres: horizontal lines bow down, most at the top",
            "frame_flex, chain_zero, rotation_radius",
            "mark again with a heavier sled, or hang a known weight on a measured chain"};
  }
  static ParamInfo param(uint8_t) {
    return {"compliance", "1/N", 0, 2e-5, 5.2e-6, "strain per newton of tension", 7e-7};
  }
  static const char* noun() { return "chain stretch"; }
  static PlainInfo plain(uint8_t) {
    return {"chains # longer for each metre at 100 N", "chains # shorter for each metre at 100 N",
            "mm", 1e5};
  }

  static CheckInfo check() {
    return {"a weight on a measured chain",
            "Hang 10 kg on {3 m|118 1/8 inches} of chain and measure how much longer it becomes, "
            "to {0.2 mm|0.0079 inch}.",
            "mm longer / 3000 mm / 98 N", 20};
  }
  static ReadingInfo reading(uint8_t) {
    const double pull = 98.1, length = 3000;  // [N] 10 kg, [mm]
    return {"how much longer {3 m|118 1/8 inches} of chain become under 10 kg", "mm", 0.2,
            1 / pull / length, 2};
  }
  static double usual(const Frame<Real>&, uint8_t) { return param(0).typical; }
  static Example example(uint8_t) { return {"softer chain", {5.17e-6}, 20}; }
  template <class Judge>
  static void setJudge(const Frame<Real>&, const Real* parameter, Judge& judge) {
    judge.set("left.compliance", parameter[kCompliance]);
    judge.set("right.compliance", parameter[kCompliance]);
  }

  static PublishedInfo published(uint8_t) { return {kClientNumber, 1}; }

  static void prepare(const Frame<Real>& frame, const Real* parameter, Real* c) {
    c[kPerPull] = parameter[kCompliance] * frame.sled_weight;
  }

  static void adjustLength(const Real* c, Strand<Real>& strand) {
    const Real strain = c[kPerPull] * strand.pull;
    strand.length -= strain * (strand.length - strain * strand.length);
  }
};

}  // namespace kinematics
