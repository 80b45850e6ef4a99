// Frame flex: beam and motor arms give under the chains' pull, so the sprockets come nearer.
#pragma once

#include "../effect.h"

namespace kinematics {

/// A sprocket moves inward by `inward` times the horizontal pull of its chain, and down by
/// `downward` times the vertical one, which at the sprocket carries half the chain's weight more
/// than in the chain's middle. The pulls are those of strands between the sprockets at rest; the
/// strands are then drawn between the moved ones. By how much the moves change the level pull is
/// taken from the middle of the sheet, where a level move counts most: it is load * run / drop,
/// so that shares of half the gap and of the drop, load * half gap / level pull, add up (see
/// docs/decisions/0006-flex-once.md).
template <class Real>
struct FrameFlex : Effect<Real> {
  enum { kInward, kDownward, kParamCount };
  enum { kInwardByPull, kDownwardByPull, kDownwardByLength, kPerHalfGap, kCoefficientCount };
  enum { kNeedsForces = 1 };
  enum { kMovesEnds = 1 };

  static EffectInfo info() {
    return {"frame_flex", "beam and motor arms bend under the pull of the chains",
            "inward: the top centre drops, lines bow down; downward: the middle drops, sides more",
            "chain_stretch, chain_pitch, tape_scale",
            "push the arms and watch a dial gauge, or mark again with a heavier sled"};
  }
  static ParamInfo param(uint8_t i) {
    if (i == kInward)
      return {"inward", "mm/N", 0,
              0.08,     0.007,  "each motor towards the other, per horizontal pull"};
    return {"downward", "mm/N", 0, 0.08, 0.02, "each motor, per vertical pull of its chain"};
  }

  static void prepare(const Frame<Real>& frame, const Real* parameter, Real* c) {
    c[kInwardByPull] = parameter[kInward] * frame.sled_weight;
    c[kDownwardByPull] = parameter[kDownward] * frame.sled_weight;
    c[kPerHalfGap] = Real(2) / frame.motor_gap;
    c[kDownwardByLength] = parameter[kDownward] * frame.chain_weight * Real(0.5);
  }

  PLUMB_RARE static void moveEnds(const Real* c, const Strand<Real>* strand,
                                  const Forces<Real>& forces, Point<Real>* span) {
    Real sunk[kSideCount];
    for (uint8_t side = kLeft; side < kSideCount; ++side) {
      sunk[side] =
          c[kDownwardByPull] * forces.upright[side] + c[kDownwardByLength] * strand[side].free;
      span[side].y -= sunk[side];
    }
    // Nearer sprockets pull less sideways, lower ones more.
    const Real inward = c[kInwardByPull] * forces.level;
    const Real nearer = inward - forces.level * (sunk[kLeft] + sunk[kRight]);
    const Real given = inward - inward * nearer * c[kPerHalfGap];
    span[kLeft].x -= given;
    span[kRight].x -= given;
  }
};

}  // namespace kinematics
