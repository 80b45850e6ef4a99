// Machines whose exact inverse judges the set-points, and random paths over their sheet.
#pragma once

#include <Kinematics.h>
#include <Motion.h>

#include <random>

#include "tried/tried.h"

/// The exact inverse of a machine, in the form that lib/Motion calls.
template <class Real>
struct Exactly {
  kinematics::Machine<Real> machine;

  motion::Lengths<Real> operator()(motion::Point<Real> place) const {
    const kinematics::PaidOut<Real> paid =
        inverse(machine, kinematics::Point<Real>{place.x, place.y});
    return {paid.chains.left, paid.chains.right, paid.found == kinematics::Found::kYes};
  }
};

/// Sag, stretch and pitch times a share, 0 for the bare frame.
template <class Real>
Exactly<Real> exactly(const Tried& tried, double sag = 1, double pitch = 1) {
  return {lawsOf<Real>(tried, sag, pitch)};
}

inline motion::Point<double> sprocketOf(const Tried& tried, int side) {
  return {(side ? 0.5 : -0.5) * tried.motor_gap, kHalfHeight + tried.motor_offset};
}

/// The most that sag adds to the slopes anywhere on the sheet: in the lower corner.
inline motion::Slopes<double> effectsOf(const Tried& tried) {
  const motion::Point<double> corner = {kHalfWidth, -kHalfHeight};
  const double sag =
      exactly<double>(tried, 1, 0)(corner).left - exactly<double>(tried, 0, 0)(corner).left;
  const double far_run = tried.motor_gap / 2 + kHalfWidth;
  const double near_run = tried.motor_gap / 2 - kHalfWidth;
  const double drop = 2 * kHalfHeight + tried.motor_offset;
  return motion::sagSlopes(sag, far_run, near_run, drop, sqrt(far_run * far_run + drop * drop));
}

/// Both sprockets of a machine, and what its effects add to the chains.
inline motion::Sprockets<float> sprocketsOf(const Tried& tried) {
  const motion::Point<double> left = sprocketOf(tried, 0), right = sprocketOf(tried, 1);
  const motion::Slopes<double> effects = effectsOf(tried);
  return {{float(left.x), float(left.y)},
          {float(right.x), float(right.y)},
          {float(effects.first), float(effects.second), float(effects.third)}};
}

/// What the bound needs to know of a path on a machine.
template <class Real>
motion::Surroundings<Real> around(const Tried& tried, const motion::Path<Real>& path) {
  const motion::Point<double> left = sprocketOf(tried, 0), right = sprocketOf(tried, 1);
  const Real to_left = clearance(path, motion::Point<Real>{Real(left.x), Real(left.y)});
  const Real to_right = clearance(path, motion::Point<Real>{Real(right.x), Real(right.y)});
  const motion::Slopes<double> effects = effectsOf(tried);
  return {to_left < to_right ? to_left : to_right,
          {Real(effects.first), Real(effects.second), Real(effects.third)}};
}

/// Random paths that stay on the sheet; every second path is near an edge.
class Paths {
 public:
  explicit Paths(unsigned seed) : random_(seed) {}

  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  motion::Point<double> place() {
    motion::Point<double> place = {between(-kHalfWidth, kHalfWidth),
                                   between(-kHalfHeight, kHalfHeight)};
    if (between(0, 1) < 0.5) {
      place.x = copysign(kHalfWidth - between(0, 100), place.x);
      place.y = copysign(kHalfHeight - between(0, 100), place.y);
    }
    return place;
  }

  /// A line of 0.05 to 400 mm.
  motion::Path<double> line() {
    for (;;) {
      const motion::Point<double> from = place();
      const double length = exp(between(log(0.05), log(400.0))), angle = between(0, 6.2831853);
      const motion::Point<double> to = {from.x + length * cos(angle), from.y + length * sin(angle)};
      if (onSheet(to)) return motion::line(from, to);
    }
  }

  /// An arc of radius 0.3 to 600 mm, every fourth a full circle.
  motion::Path<double> arc() {
    for (;;) {
      const motion::Point<double> centre = place();
      const double radius = exp(between(log(0.3), log(600.0)));
      if (!onSheet({centre.x - radius, centre.y - radius}) ||
          !onSheet({centre.x + radius, centre.y + radius}))
        continue;
      const double first = between(0, 6.2831853), second = between(0, 6.2831853);
      const motion::Point<double> from = {centre.x + radius * cos(first),
                                          centre.y + radius * sin(first)};
      motion::Point<double> to = {centre.x + radius * cos(second), centre.y + radius * sin(second)};
      if (between(0, 1) < 0.25) to = from;
      const bool clockwise = between(0, 1) < 0.5;
      return motion::arc(from, to, centre,
                         clockwise ? motion::Turn::kClockwise : motion::Turn::kCounterclockwise);
    }
  }

  static bool onSheet(motion::Point<double> place) {
    return fabs(place.x) <= kHalfWidth && fabs(place.y) <= kHalfHeight;
  }

 private:
  std::mt19937 random_;
};

/// The same path in another number type.
template <class Real>
motion::Path<Real> as(const motion::Path<double>& path) {
  const motion::Point<Real> from = {Real(path.from.x), Real(path.from.y)};
  const motion::Point<Real> to = {Real(path.to.x), Real(path.to.y)};
  if (path.sweep == 0) return motion::line(from, to);
  const motion::Point<Real> centre = {Real(path.centre.x), Real(path.centre.y)};
  return motion::arc(from, to, centre,
                     path.sweep > 0 ? motion::Turn::kCounterclockwise : motion::Turn::kClockwise);
}
