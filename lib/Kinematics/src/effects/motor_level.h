// Motor level: the beam is not horizontal, so the two sprockets differ in height.
#pragma once

#include "../effect.h"

namespace kinematics {

/// Moves the right sprocket up and the left sprocket down, each by half the difference.
///
/// This rotates everything about the middle of the motors by difference / gap. Marks on a single
/// sheet hardly tell that from a sheet that lies askew: only the direction of gravity differs, and
/// its effect is small.
template <class Real>
struct MotorLevel : Effect<Real> {
  enum { kHeightDifference, kParamCount };
  enum { kHalf, kCoefficientCount };
  enum { kInFrame = 1 };  // a turned sheet looks the same

  static EffectInfo info() {
    return {"motor_level", "the motors are not level: the right motor is higher, or lower",
            "everything turns about the middle of the motors; sizes stay right",
            "sheet_rotation, chain_zero",
            "lay a spirit level or a water hose across the sprockets' axes"};
  }
  static ParamInfo param(uint8_t) {
    return {"height_difference", "mm", -30, 30, 4, "right sprocket above the left sprocket", 1};
  }
  static const char* noun() { return "motors that are not level"; }
  static PlainInfo plain(uint8_t) { return {"right motor # higher", "right motor # lower", "mm"}; }

  static CheckInfo check() {
    return {"a level over the motors",
            "Lay a spirit level on a straight edge, or a water hose, across both sprockets and "
            "measure how much higher the right axis is, to {1 mm|0.039 inch}.",
            "mm, negative if the left axis is higher", 8};
  }
  static ReadingInfo reading(uint8_t) { return {"how much higher the right motor is", "mm", 1, 1}; }
  static Example example(uint8_t) { return {"right motor higher", {4}, 20}; }
  template <class Judge>
  static void setJudge(const Frame<Real>&, const Real* parameter, Judge& judge) {
    judge.set("height_difference", parameter[kHeightDifference]);
  }

  static void prepare(const Frame<Real>&, const Real* parameter, Real* c) {
    c[kHalf] = parameter[kHeightDifference] * Real(0.5);
  }

  static void moveSprocket(const Real* c, Point<Real>* sprocket) {
    sprocket[kLeft].y -= c[kHalf];
    sprocket[kRight].y += c[kHalf];
  }
};

}  // namespace kinematics
