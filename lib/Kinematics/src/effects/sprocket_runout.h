// Sprocket runout: a bore or set screw off centre swings the sprocket as it turns.
#pragma once

#include <math.h>

#include "../effect.h"

namespace kinematics {

/// A sprocket whose axis is e off its middle moves the chain's start by e along the chain, once a
/// turn. Seen along the chain, the sprocket has turned by b = length / radius since the chain's far
/// end was at its tangent point: the wrap follows the chain's direction and drops out. So the
/// length errs by sine * sin(b) + cosine * cos(b), the same over the top and off the bottom.
template <class Real>
struct SprocketRunout : Effect<Real> {
  enum { kLeftSine, kLeftCosine, kRightSine, kRightCosine, kParamCount };
  enum { kTurnsByLength = kParamCount, kCoefficientCount };

  static EffectInfo info() {
    return {
        "sprocket_runout", "a sprocket's axis is off its middle, so chain comes off in waves",
        "waves of one sprocket's circumference (63.5 mm) along each chain; noise on coarse grids",
        "nothing smooth; chain_zero if all marks lie a whole turn apart",
        "turn the sprocket by half a turn under the same mark, or gauge its rim"};
  }
  static ParamInfo param(uint8_t i) {
    static const char* const kNames[] = {"left_sine", "left_cosine", "right_sine", "right_cosine"};
    return {kNames[i], "mm", -0.5,
            0.5,       0.1,  "amplitude of the length error, by the turn of the sprocket"};
  }

  static void prepare(const Frame<Real>& frame, const Real* parameter, Real* c) {
    for (uint8_t i = 0; i < kParamCount; ++i) c[i] = parameter[i];
    c[kTurnsByLength] = Real(1) / frame.sprocket_radius;
  }

  PLUMB_RARE static void adjustLength(const Real* c, Strand<Real>& strand) {
    const Real turn = strand.length * c[kTurnsByLength];
    const Real* own = strand.side == kLeft ? c + kLeftSine : c + kRightSine;
    strand.length += own[0] * sin(turn) + own[1] * cos(turn);
  }
};

}  // namespace kinematics
