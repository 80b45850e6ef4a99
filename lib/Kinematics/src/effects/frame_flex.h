// Frame flex: beam and motor arms give under the chains' pull, so the sprockets come nearer.
#pragma once

#include "../effect.h"

namespace kinematics {

/// A sprocket moves inward by `inward` times the horizontal pull of its chain, and down by
/// `downward` times the vertical pull. The vertical pull at the sprocket is larger than in the
/// chain's middle by half the chain's weight.
///
/// The pulls are those of strands between sprockets at rest; the strands are then drawn between
/// the moved sprockets. The moves change the level pull, which is load * run / drop: a move inward
/// takes its share of half the gap, a move down its share of the drop, load * half gap / level
/// pull, and the two shares add up. The formula takes this change from the middle of the sheet,
/// where a level move counts most (see docs/kinematics.md).
template <class Real>
struct FrameFlex : Effect<Real> {
  enum { kInward, kDownward, kParamCount };
  enum { kInwardByPull, kDownwardByPull, kDownwardByLength, kPerHalfGap, kCoefficientCount };
  enum { kNeedsForces = 1, kMovesEnds = 1 };
  enum { kExampleCount = 3 };

  static EffectInfo info() {
    return {"frame_flex", "beam and motor arms bend under the pull of the chains",
            "inward: the top centre drops, lines bow down; downward: the middle drops, sides more",
            "chain_stretch, chain_pitch, tape_scale",
            "push the arms and watch a dial gauge, or mark again with a heavier sled"};
  }
  static ParamInfo param(uint8_t i) {
    if (i == kInward)
      return {"inward", "mm/N", 0, 0.08, 0.007, "each motor towards the other, per horizontal pull",
              0.002};
    return {"downward", "mm/N", 0, 0.08, 0.02, "each motor, per vertical pull of its chain", 0.002};
  }
  static const char* noun() { return "motor arms that bend"; }
  static PlainInfo plain(uint8_t i) {
    if (i == kInward)
      return {"each motor comes inward by # at 100 N", "each motor goes outward by # at 100 N",
              "mm", 100};
    return {"each motor sinks by # at 100 N", "each motor rises by # at 100 N", "mm", 100};
  }

  static CheckInfo check() {
    return {"a gauge at the motor arms",
            "Pull each motor inwards, then down, with 50 N (a luggage scale) and read on a dial "
            "gauge how far the sprocket moves, to {0.1 mm|0.0039 inch}.",
            "mm moved over newtons pulled, inwards and downwards", 20};
  }
  static ReadingInfo reading(uint8_t i) {
    const char* const title = i == kInward ? "how far a motor moves inwards under 50 N"
                                           : "how far a motor moves down under 50 N";
    return {title, "mm", 0.1, 1 / 50.0, 2};
  }
  static Example example(uint8_t i) {
    static const Example kExamples[] = {{"inward and downward", {0.007, 0.02}, 20},
                                        {"inward", {0.007, 0}, 20},
                                        {"downward", {0, 0.02}, 20}};
    return kExamples[i];
  }
  template <class Judge>
  static void setJudge(const Frame<Real>&, const Real* parameter, Judge& judge) {
    judge.set("left.inward", parameter[kInward]);
    judge.set("right.inward", parameter[kInward]);
    judge.set("left.downward", parameter[kDownward]);
    judge.set("right.downward", parameter[kDownward]);
  }

  static void prepare(const Frame<Real>& frame, const Real* parameter, Real* c) {
    c[kInwardByPull] = parameter[kInward] * frame.sled_weight;
    c[kDownwardByPull] = parameter[kDownward] * frame.sled_weight;
    c[kPerHalfGap] = Real(2) / frame.motor_gap;
    c[kDownwardByLength] = parameter[kDownward] * frame.chain_weight * Real(0.5);
  }

  template <class SomeForces>
  PLUMB_RARE static void moveEnds(const Real* c, const Strand<Real>* strand,
                                  const SomeForces& forces, Point<Real>* span) {
    Real sunk[kSideCount];
    for (uint8_t side = kLeft; side < kSideCount; ++side) {
      sunk[side] =
          c[kDownwardByPull] * forces.upright[side] + c[kDownwardByLength] * strand[side].free;
      span[side].y -= sunk[side];
    }
    const Real all_sunk = sunk[kLeft] + sunk[kRight];
    const Real left = given(c, forces.levelOf(kLeft), all_sunk);
    const Real right = given(c, forces.levelOf(kRight), all_sunk);
    span[kLeft].x -= left;
    span[kRight].x -= right;
  }

 private:
  /// [mm] by which a sprocket moves inward. The chains pull less sideways between nearer sprockets
  /// and more from lower sprockets.
  PLUMB_INLINE static Real given(const Real* c, Real level, Real all_sunk) {
    const Real inward = c[kInwardByPull] * level;
    const Real nearer = inward - level * all_sunk;
    return inward - inward * nearer * c[kPerHalfGap];
  }
};

}  // namespace kinematics
