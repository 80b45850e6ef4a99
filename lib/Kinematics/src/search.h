// Steps that all searches for a place share, whether the sled hangs on a ring or on two brackets.
#pragma once

#include <math.h>

#include "strand.h"

namespace kinematics {

const uint8_t kMostTries = 20;
// A step as short as kLastStep ends the search: as slopes change along it, it misses an encoder
// count at most. Beyond kLongestStep the slopes are no guide.
const float kLastStep = 0.15f;      // [mm]
const float kLongestStep = 400.0f;  // [mm]

template <class Real>
Real clamp(Real value, Real low, Real high) {
  if (value > high) return high;
  return value > low ? value : low;  // a NaN ends here too
}

/// True for a part of a step that is no longer than `most`; false for NaN.
template <class Real>
bool isWithin(Real part, float most) {
  return fabs(part) < Real(most);
}

/// Whether chains that hold `across` [mm] of sled between them reach from sprocket to sprocket.
template <class Real>
bool canMeet(Chains<Real> chains, Real across, Real gap) {
  const Real sum = chains.left + chains.right + across;
  return sum > gap && sum < Real(8) * gap;
}

/// Where two lines of these lengths meet that start `gap` [mm] apart: run from the left start, and
/// drop.
template <class Real>
Point<Real> meet(Real left, Real right, Real gap) {
  const Real run = (gap + (left - right) * (left + right) / gap) * Real(0.5);
  const Real drop_squared = left * left - run * run;
  return {run, drop_squared > Real(0) ? Real(sqrt(drop_squared)) : Real(0)};
}

/// Step of a bit whose chains are short by these errors [mm]. The slopes of both lengths are the
/// directions of the strands, so a strand must have sine and cosine.
template <class Strand, class Real>
Point<Real> stepOf(const Strand& left, const Strand& right, Real sine_of_sum, Real left_error,
                   Real right_error) {
  const Real scale = Real(1) / sine_of_sum;
  return {(right.sine * left_error - left.sine * right_error) * scale,
          -(right.cosine * left_error + left.cosine * right_error) * scale};
}

}  // namespace kinematics
