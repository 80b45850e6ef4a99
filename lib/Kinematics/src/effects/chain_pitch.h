// Chain pitch: links made, or worn, longer than nominal, so fewer of them reach the same distance.
#pragma once

#include "../effect.h"

namespace kinematics {

/// Free chain of length L is L / (1 + strain) nominal lengths of chain. Left and right differ.
///
/// This holds for free chain only: on the sprocket the links sit at the pitch of the teeth, and the
/// ring's arm is no chain at all. (The published firmware divides the arm too: 0.28 mm at 0.2 %.)
template <class Real>
struct ChainPitch : Effect<Real> {
  enum { kLeftStrain, kRightStrain, kParamCount };
  enum { kCoefficientCount = kSideCount };
  enum { kExampleCount = 3 };

  static EffectInfo info() {
    return {"chain_pitch", "each chain's links are longer than nominal, by manufacture or wear",
            "both alike: everything grows in x and drops; one alone: that side's far edge drifts",
            "tape_scale, frame_flex, chain_zero",
            "measure 100 links of each chain under the same pull, or use a certified length"};
  }
  static ParamInfo param(uint8_t i) {
    if (i == kLeftStrain)
      return {"left", "1", -0.001, 0.006, 0.001, "strain of the left chain", 0.0003};
    return {"right", "1", -0.001, 0.006, 0.001, "strain of the right chain", 0.0003};
  }
  static const char* noun() { return "chains too long or too short"; }
  static PlainInfo plain(uint8_t i) {
    if (i == kLeftStrain) return {"left chain # too long", "left chain # too short", "%", 100};
    return {"right chain # too long", "right chain # too short", "%", 100};
  }

  static CheckInfo check() {
    return {"100 links of each chain",
            "Lay 100 links of each chain, pulled tight, along a steel rule: they should be "
            "{635 mm (25 inches)|25 inches}; read to {0.2 mm|0.0079 inch}.",
            "(read - 635) / 635, of each chain", 15};
  }
  static ReadingInfo reading(uint8_t i) {
    const char* const title =
        i == kLeftStrain ? "100 links of the left chain" : "100 links of the right chain";
    return {title, "mm", 0.2, 1 / 635.0, 1, 635};
  }
  static Example example(uint8_t i) {
    static const Example kExamples[] = {{"both alike", {0.001, 0.001}, 20},
                                        {"left more", {0.001, 0.0003}, 20},
                                        {"right", {0, 0.001}, 20}};
    return kExamples[i];
  }
  template <class Judge>
  static void setJudge(const Frame<Real>&, const Real* parameter, Judge& judge) {
    judge.set("left.pitch", parameter[kLeftStrain]);
    judge.set("right.pitch", parameter[kRightStrain]);
  }

  static PublishedInfo published(uint8_t i) { return {40 + i, 100}; }
  static void addPublished(const Frame<Real>&, const PublishedChains<Real>& published,
                           Real* parameter) {
    for (uint8_t i = 0; i < kParamCount; ++i) parameter[i] += published.strain[i];
  }

  /// A length L becomes L + L * c with c = -strain / (1 + strain), so a move needs no division.
  static void prepare(const Frame<Real>&, const Real* parameter, Real* c) {
    for (uint8_t i = 0; i < kParamCount; ++i) c[i] = -(parameter[i] / (Real(1) + parameter[i]));
  }

  static void adjustLength(const Real* c, Strand<Real, false>& strand) {
    strand.length += c[strand.side] * strand.length;
  }
};

}  // namespace kinematics
