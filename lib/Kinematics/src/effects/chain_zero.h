// Chain zero: more or less chain was out than counted when a sprocket's count was set.
#pragma once

#include "../effect.h"

namespace kinematics {

/// The motor has paid out what is needed less what was out already at 12 o'clock.
///
/// Both sides alike are exactly a wrong rotation_radius; a skipped tooth is one pitch, 6.35 mm.
template <class Real>
struct ChainZero : Effect<Real> {
  enum { kLeftOut, kRightOut, kParamCount };
  enum { kCoefficientCount = kSideCount };

  static EffectInfo info() {
    return {"chain_zero", "a chain was not at its mark when its sprocket's count was set",
            "the whole job moves and turns; a skipped tooth moves it by centimetres",
            "rotation_radius, motor_gap, sheet_rotation",
            "bring both sprockets back to 12 o'clock and look whether the marked links are there"};
  }
  static ParamInfo param(uint8_t i) {
    if (i == kLeftOut) return {"left", "mm", -30, 30, 2, "left chain out at 12 o'clock"};
    return {"right", "mm", -30, 30, 2, "right chain out at 12 o'clock"};
  }

  static void prepare(const Frame<Real>&, const Real* parameter, Real* c) {
    for (uint8_t i = 0; i < kParamCount; ++i) c[i] = parameter[i];
  }

  PLUMB_RARE static void adjustLength(const Real* c, Strand<Real>& strand) {
    strand.length -= c[strand.side];
  }
};

}  // namespace kinematics
