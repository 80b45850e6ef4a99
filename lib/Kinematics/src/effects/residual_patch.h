// Residual patch: a smooth correction of each chain's length over the sheet. Not physics.
#pragma once

#include "../effect.h"

namespace kinematics {

/// For errors that no known cause explains: each chain is longer by a polynomial of the third
/// degree of the sled's place, without a constant.
///
/// The place follows from the strand: (free + arm) along its direction from the sprocket. Its x is
/// counted from the middle between the motors in units of 0.42 motor_gap, its y in units of 0.6
/// motor_height: each unit is about half a sheet. The terms are products of Legendre polynomials,
/// so no term exceeds its parameter. Beyond half a sheet they keep the value at its edge, so they
/// do not grow where nothing was measured.
template <class Real>
struct ResidualPatch : Effect<Real> {
  enum { kX, kY, kXX, kXY, kYY, kXXX, kXXY, kXYY, kYYY, kTerms };
  enum { kParamCount = kSideCount * kTerms };
  enum { kConstant, kPowers = 1 + kTerms };  // for each side
  enum { kArm = kSideCount * kPowers, kPerAcross, kAcross, kPerDown, kDown, kCoefficientCount };
  enum { kEmpirical = 1, kNeedsForces = 1 };  // forces for the directions
  enum { kExampleCount = 0 };

  static EffectInfo info() {
    return {"residual_patch", "no cause at all: a smooth map of what the effects leave unexplained",
            "whatever is left, as far as it is smooth over the sheet", "everything",
            "look for the cause; the patch holds for this machine, sled and sheet as they are"};
  }
  static ParamInfo param(uint8_t i) {
    static const char* const kNames[] = {
        "left_x",   "left_y",   "left_xx",   "left_xy",   "left_yy",   "left_xxx",
        "left_xxy", "left_xyy", "left_yyy",  "right_x",   "right_y",   "right_xx",
        "right_xy", "right_yy", "right_xxx", "right_xxy", "right_xyy", "right_yyy"};
    return {kNames[i], "mm", -20, 20, 0.5, "chain added by this term at its largest", 0};
  }

  static CheckInfo check() { return {"", "", "", 0}; }

  /// Turns Legendre's polynomials into powers, so that the hook needs a single product for each
  /// term.
  static void prepare(const Frame<Real>& frame, const Real* parameter, Real* c) {
    for (uint8_t side = kLeft; side < kSideCount; ++side) {
      const Real* const p = parameter + side * kTerms;
      Real* const power = c + side * kPowers;
      const Real half_xx = Real(0.5) * p[kXX], half_yy = Real(0.5) * p[kYY];
      power[kConstant] = -(half_xx + half_yy);
      power[1 + kX] = p[kX] - Real(1.5) * p[kXXX] - Real(0.5) * p[kXYY];
      power[1 + kY] = p[kY] - Real(1.5) * p[kYYY] - Real(0.5) * p[kXXY];
      power[1 + kXX] = Real(3) * half_xx;
      power[1 + kXY] = p[kXY];
      power[1 + kYY] = Real(3) * half_yy;
      power[1 + kXXX] = Real(2.5) * p[kXXX];
      power[1 + kXXY] = Real(1.5) * p[kXXY];
      power[1 + kXYY] = Real(1.5) * p[kXYY];
      power[1 + kYYY] = Real(2.5) * p[kYYY];
    }
    c[kArm] = frame.rotation_radius;
    c[kPerAcross] = Real(1) / (Real(0.42) * frame.motor_gap);
    c[kAcross] = frame.motor_gap / Real(2) * c[kPerAcross];
    c[kPerDown] = Real(1) / (Real(0.6) * frame.motor_height);
    c[kDown] = frame.motor_height * c[kPerDown];
  }

  PLUMB_RARE static void adjustLength(const Real* c, Strand<Real>& strand) {
    const Real reach = strand.free + c[kArm];
    const Real inward = within(reach * strand.cosine * c[kPerAcross] - c[kAcross]);
    const Real y = within(c[kDown] - reach * strand.sine * c[kPerDown]);
    const bool right = strand.side == kRight;
    const Real x = right ? -inward : inward;
    const Real* const power = right ? c + kPowers : c;
    const Real* const p = power + 1;
    strand.length +=
        power[kConstant] + y * (p[kY] + y * (p[kYY] + y * p[kYYY])) +
        x * (p[kX] + y * (p[kXY] + y * p[kXYY]) + x * (p[kXX] + y * p[kXXY] + x * p[kXXX]));
  }

 private:
  static Real within(Real share) {
    if (share > Real(1)) return Real(1);
    if (share < Real(-1)) return Real(-1);
    return share;
  }
};

}  // namespace kinematics
