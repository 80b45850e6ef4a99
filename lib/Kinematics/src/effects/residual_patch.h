// Residual patch: a smooth correction of each chain's length over the sheet. Not physics.
#pragma once

#include "../effect.h"

namespace kinematics {

/// What is left when no known cause explains it: each chain longer by a polynomial of the third
/// degree of the sled's place, without its constant.
///
/// The place is told by the strand itself: (free + arm) along its direction from the sprocket. It
/// is counted from the middle between the motors, x right in 0.42 motor_gap and y up in 0.6
/// motor_height, about half a sheet each way. The terms are products of Legendre polynomials, so
/// that each is worth at most its own size; beyond one half sheet they stay as they are there, so
/// nothing runs away where nobody measured.
template <class Real>
struct ResidualPatch : Effect<Real> {
  enum { kX, kY, kXX, kXY, kYY, kXXX, kXXY, kXYY, kYYY, kTerms };
  enum { kParamCount = kSideCount * kTerms };
  enum { kArm = kParamCount, kPerAcross, kAcross, kPerDown, kDown, kCoefficientCount };
  enum { kEmpirical = 1 };

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
    return {kNames[i], "mm", -20, 20, 0.5, "chain added by this term at its largest"};
  }

  static void prepare(const Frame<Real>& frame, const Real* parameter, Real* c) {
    for (uint8_t i = 0; i < kParamCount; ++i) c[i] = parameter[i];
    c[kArm] = frame.rotation_radius;
    c[kPerAcross] = Real(1) / (Real(0.42) * frame.motor_gap);
    c[kAcross] = frame.motor_gap / Real(2) * c[kPerAcross];
    c[kPerDown] = Real(1) / (Real(0.6) * frame.motor_height);
    c[kDown] = frame.motor_height * c[kPerDown];
  }

  PLUMB_RARE static void adjustLength(const Real* c, Strand<Real>& strand) {
    const Real reach = strand.free + c[kArm];
    const Real inward = reach * strand.cosine * c[kPerAcross] - c[kAcross];
    const bool right = strand.side == kRight;
    const Real x = within(right ? -inward : inward);
    const Real y = within(c[kDown] - reach * strand.sine * c[kPerDown]);
    const Real* const p = right ? c + kTerms : c;
    const Real xx = Real(1.5) * x * x - Real(0.5), yy = Real(1.5) * y * y - Real(0.5);
    const Real xxx = (Real(2.5) * x * x - Real(1.5)) * x;
    const Real yyy = (Real(2.5) * y * y - Real(1.5)) * y;
    strand.length += p[kX] * x + p[kY] * y + p[kXX] * xx + p[kXY] * x * y + p[kYY] * yy +
                     p[kXXX] * xxx + p[kXXY] * xx * y + p[kXYY] * x * yy + p[kYYY] * yyy;
  }

 private:
  static Real within(Real share) {
    if (share > Real(1)) return Real(1);
    if (share < Real(-1)) return Real(-1);
    return share;
  }
};

}  // namespace kinematics
