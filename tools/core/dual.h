// Dual numbers: a formula that runs on them also gives its exact derivatives.
#pragma once

#include <math.h>
#include <stdint.h>

#include <array>
#include <cmath>

namespace dual {

/// A value and its derivatives by Count inputs. Its operators are friends, so that a plain number
/// converts on either side.
template <int Count>
struct Dual {
  double value = 0;
  std::array<double, Count> slope{};

  Dual() = default;
  Dual(double constant) : value(constant) {}  // NOLINT: constants must mix in freely

  /// The input number `index`, at `value`.
  static Dual input(double value, int index) {
    Dual result(value);
    result.slope[static_cast<size_t>(index)] = 1;
    return result;
  }

  /// f(a) with value f and derivative df.
  static Dual chain(const Dual& a, double f, double df) {
    Dual result(f);
    for (int i = 0; i < Count; ++i) result.slope[i] = df * a.slope[i];
    return result;
  }
  /// f(a, b) with value f and partial derivatives da and db.
  static Dual chain(const Dual& a, const Dual& b, double f, double da, double db) {
    Dual result(f);
    for (int i = 0; i < Count; ++i) result.slope[i] = da * a.slope[i] + db * b.slope[i];
    return result;
  }

  friend Dual operator+(const Dual& a, const Dual& b) {
    return chain(a, b, a.value + b.value, 1, 1);
  }
  friend Dual operator-(const Dual& a, const Dual& b) {
    return chain(a, b, a.value - b.value, 1, -1);
  }
  friend Dual operator*(const Dual& a, const Dual& b) {
    return chain(a, b, a.value * b.value, b.value, a.value);
  }
  friend Dual operator/(const Dual& a, const Dual& b) {
    return chain(a, b, a.value / b.value, 1 / b.value, -a.value / (b.value * b.value));
  }
  friend Dual operator-(const Dual& a) { return chain(a, -a.value, -1); }
  friend Dual& operator+=(Dual& a, const Dual& b) { return a = a + b; }
  friend Dual& operator-=(Dual& a, const Dual& b) { return a = a - b; }
  friend bool operator<(const Dual& a, const Dual& b) { return a.value < b.value; }
  friend bool operator>(const Dual& a, const Dual& b) { return a.value > b.value; }

  friend Dual sqrt(const Dual& a) {
    const double root = ::sqrt(a.value);
    return chain(a, root, 0.5 / root);
  }
  friend Dual sin(const Dual& a) { return chain(a, ::sin(a.value), ::cos(a.value)); }
  friend Dual cos(const Dual& a) { return chain(a, ::cos(a.value), -::sin(a.value)); }
  friend bool isfinite(const Dual& a) { return std::isfinite(a.value); }
  friend bool signbit(const Dual& a) { return std::signbit(a.value); }
  /// The nearest whole number, which has no slopes.
  friend int16_t nearest(const Dual& a) { return static_cast<int16_t>(std::lround(a.value)); }

  /// True if value and slopes are all zero. A zero with a slope must still be computed.
  friend bool isZero(const Dual& a) {
    if (a.value != 0) return false;
    for (double slope : a.slope)
      if (slope != 0) return false;
    return true;
  }
};

}  // namespace dual
