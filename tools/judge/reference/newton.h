// Newton's method with halved steps, for a few unknowns that are scaled to a size of about 1.
#pragma once

#include <Eigen/Dense>
#include <cmath>

namespace reference {

/// The result of the search.
template <int n>
struct Root {
  bool found = false;
  Eigen::Matrix<double, n, 1> at;  ///< valid only if `found`
  int steps = 0;                   ///< Newton steps taken
};

const int kMostSteps = 60;
const int kMostHalvings = 40;
const double kSlopeStep = 1e-6;     // central: errs by 1e-12 from curvature, 1e-10 from rounding
const double kSmallStep = 1e-11;    // the error after such a step is its square, or rounding
const double kSmallDefect = 1e-12;  // in units of about a machine's size: some 1e-9 mm

/// Slopes of `defect` by central differences.
template <int n, class Defect>
Eigen::Matrix<double, n, n> slopesOf(const Defect& defect, Eigen::Matrix<double, n, 1> at) {
  Eigen::Matrix<double, n, n> slopes;
  for (int i = 0; i < n; ++i) {
    const double here = at[i];
    at[i] = here + kSlopeStep;
    slopes.col(i) = defect(at);
    at[i] = here - kSlopeStep;
    slopes.col(i) -= defect(at);
    at[i] = here;
  }
  return slopes / (2 * kSlopeStep);
}

/// Finds where `defect` (a function of n numbers that returns n) vanishes.
template <int n, class Defect>
Root<n> findRoot(const Defect& defect, Eigen::Matrix<double, n, 1> at) {
  using Vector = Eigen::Matrix<double, n, 1>;
  Root<n> root;
  Vector value = defect(at);
  while (value.allFinite() && root.steps < kMostSteps) {
    ++root.steps;
    const Vector step = slopesOf<n>(defect, at).partialPivLu().solve(value);
    if (!step.allFinite()) break;
    const bool last = step.template lpNorm<Eigen::Infinity>() < kSmallStep;
    double share = 1;
    Vector next = at - step, next_value = defect(next);
    for (int i = 0; !last && i < kMostHalvings; ++i) {
      if (next_value.norm() < value.norm()) break;  // false for NaN, too
      share /= 2;
      next = at - share * step;
      next_value = defect(next);
    }
    const bool better = next_value.norm() < value.norm();
    if (better) at = next;
    if (better) value = next_value;
    // No progress may also mean that only rounding is left.
    if (last || !better) break;
  }
  root.found = value.allFinite() && value.template lpNorm<Eigen::Infinity>() < kSmallDefect;
  root.at = at;
  return root;
}

}  // namespace reference
