// Curves of tangent arcs as a program's text gives them, rounded to its last digit, and the
// distance of a place from the intended curve.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>

/// A place on the sheet [mm].
struct SheetPlace {
  double x, y;
};

/// An arc before its numbers are rounded.
struct Meant {
  SheetPlace from, to, centre;
  double radius, first, sweep;  ///< [mm], [rad] direction of its start from the centre, [rad]

  SheetPlace at(double share) const {
    const double angle = first + sweep * share;
    return {centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)};
  }

  double distanceTo(SheetPlace place) const {
    const double x = place.x - centre.x, y = place.y - centre.y;
    double turned = std::fmod((std::atan2(y, x) - first) * (sweep > 0 ? 1 : -1), 2 * M_PI);
    if (turned < 0) turned += 2 * M_PI;
    if (turned <= std::fabs(sweep)) return std::fabs(std::hypot(x, y) - radius);
    return std::min(std::hypot(place.x - from.x, place.y - from.y),
                    std::hypot(place.x - to.x, place.y - to.y));
  }
};

/// An arc as a program writes it [mm], rounded to the last digit.
struct Rounded {
  SheetPlace from, to, centre;
  double radius;  ///< as for R: negative for the long way round
};

inline double rounded(double value, double digit) { return std::round(value / digit) * digit; }

inline SheetPlace rounded(SheetPlace place, double digit) {
  return {rounded(place.x, digit), rounded(place.y, digit)};
}

/// The words of an arc; I and J count from its start.
inline Rounded rounded(const Meant& meant, double digit) {
  const SheetPlace from = rounded(meant.from, digit);
  const SheetPlace centre = {from.x + rounded(meant.centre.x - meant.from.x, digit),
                             from.y + rounded(meant.centre.y - meant.from.y, digit)};
  const double radius = rounded(meant.radius, digit);
  return {from, rounded(meant.to, digit), centre, std::fabs(meant.sweep) > M_PI ? -radius : radius};
}

/// A curve of tangent arcs, from 0.05 to 50 mm in radius and in length.
class Curve {
 public:
  Curve(unsigned seed, double most_sweep) : random_(seed), most_sweep_(most_sweep) {}

  Meant next() {
    const double radius = std::exp(between(std::log(0.05), std::log(50)));
    const double length = std::exp(between(std::log(0.05), std::log(50)));
    const double side = between(0, 1) < 0.5 ? -1 : 1;
    Meant arc;
    arc.radius = radius;
    arc.sweep = side * std::min(length / radius, most_sweep_);
    arc.from = at_;
    arc.centre = {at_.x - side * radius * std::sin(ahead_),
                  at_.y + side * radius * std::cos(ahead_)};
    arc.first = std::atan2(at_.y - arc.centre.y, at_.x - arc.centre.x);
    arc.to = arc.at(1);
    at_ = arc.to;
    ahead_ += arc.sweep;
    return arc;
  }

 private:
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  std::mt19937 random_;
  double most_sweep_;
  SheetPlace at_ = {300, -200};
  double ahead_ = 0.3;  ///< [rad] direction of the curve
};
