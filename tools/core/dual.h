// Dual numbers: a formula that runs on them also gives its exact derivatives.
#pragma once

#include <math.h>
#include <stdint.h>

#include <array>
#include <cmath>

namespace dual {

/// A value and its derivatives by Count inputs.
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
};

/// f(a) with value f and derivative df.
template <int Count>
Dual<Count> chain(const Dual<Count>& a, double f, double df) {
  Dual<Count> result(f);
  for (int i = 0; i < Count; ++i) result.slope[i] = df * a.slope[i];
  return result;
}

/// f(a, b) with value f and partial derivatives da and db.
template <int Count>
Dual<Count> chain(const Dual<Count>& a, const Dual<Count>& b, double f, double da, double db) {
  Dual<Count> result(f);
  for (int i = 0; i < Count; ++i) result.slope[i] = da * a.slope[i] + db * b.slope[i];
  return result;
}

// Friends of arithmetic; a plain number converts on either side.
#define PLUMB_DUAL_OPERATOR(sign, f, da, db)                              \
  template <int Count>                                                    \
  Dual<Count> operator sign(const Dual<Count>& a, const Dual<Count>& b) { \
    return chain(a, b, f, da, db);                                        \
  }
PLUMB_DUAL_OPERATOR(+, a.value + b.value, 1.0, 1.0)
PLUMB_DUAL_OPERATOR(-, a.value - b.value, 1.0, -1.0)
PLUMB_DUAL_OPERATOR(*, a.value* b.value, b.value, a.value)
PLUMB_DUAL_OPERATOR(/, a.value / b.value, 1 / b.value, -a.value / (b.value * b.value))
#undef PLUMB_DUAL_OPERATOR

template <int Count>
Dual<Count> operator-(const Dual<Count>& a) {
  return chain(a, -a.value, -1.0);
}
template <int Count>
Dual<Count>& operator+=(Dual<Count>& a, const Dual<Count>& b) {
  return a = a + b;
}
template <int Count>
Dual<Count>& operator-=(Dual<Count>& a, const Dual<Count>& b) {
  return a = a - b;
}

template <int Count>
bool operator<(const Dual<Count>& a, const Dual<Count>& b) {
  return a.value < b.value;
}
template <int Count>
bool operator>(const Dual<Count>& a, const Dual<Count>& b) {
  return a.value > b.value;
}

template <int Count>
Dual<Count> sqrt(const Dual<Count>& a) {
  const double root = ::sqrt(a.value);
  return chain(a, root, 0.5 / root);
}
template <int Count>
Dual<Count> sin(const Dual<Count>& a) {
  return chain(a, ::sin(a.value), ::cos(a.value));
}
template <int Count>
Dual<Count> cos(const Dual<Count>& a) {
  return chain(a, ::cos(a.value), -::sin(a.value));
}

template <int Count>
bool isfinite(const Dual<Count>& a) {
  return std::isfinite(a.value);
}
template <int Count>
bool signbit(const Dual<Count>& a) {
  return std::signbit(a.value);
}

/// The nearest whole number, which has no slopes.
template <int Count>
int16_t nearest(const Dual<Count>& a) {
  return static_cast<int16_t>(std::lround(a.value));
}

/// True if value and slopes are all zero. A zero with a slope must still be computed.
template <int Count>
bool isZero(const Dual<Count>& a) {
  if (a.value != 0) return false;
  for (double slope : a.slope)
    if (slope != 0) return false;
  return true;
}

}  // namespace dual
