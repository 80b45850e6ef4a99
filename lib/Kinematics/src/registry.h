// A list of effects, unrolled by the compiler: no virtual call, no heap, no start-up code.
#pragma once

#include <stdint.h>

#include "effect.h"

namespace kinematics {

/// One line of the registry: an effect and the number of its first $-setting.
/// A number that was once released keeps its meaning for ever.
template <int FirstSetting, template <class> class EffectTemplate>
struct At {
  enum { kFirstSetting = FirstSetting };
  template <class Real>
  using Type = EffectTemplate<Real>;
};

/// True where a number is exactly zero; a dual number brings its own, which also looks at slopes.
inline bool isZero(float value) { return value == 0.0f; }
inline bool isZero(double value) { return value == 0.0; }

template <class Real, uint8_t Index, class... Entries>
struct Chain;

/// End of the list.
template <class Real, uint8_t Index>
struct Chain<Real, Index> {
  enum { kParamCount = 0, kLowestSetting = 256, kForceMask = 0 };
  static uint16_t presentMask(const Real*) { return 0; }
  static void prepare(const Real*, Real*) {}
  static void adjustLength(const Real*, uint16_t, Strand<Real>&) {}
  template <class Visitor>
  static void visit(Visitor&) {}
};

template <class Real, uint8_t Index, class First, class... Rest>
struct Chain<Real, Index, First, Rest...> {
  typedef typename First::template Type<Real> Own;
  typedef Chain<Real, Index + 1, Rest...> Next;
  enum {
    kOwnCount = Own::kParamCount,
    kParamCount = kOwnCount + Next::kParamCount,
    kLowestSetting = First::kFirstSetting,
    kForceMask = (Own::kNeedsForces << Index) | Next::kForceMask
  };
  static_assert(Index < 16, "the mask of present effects has 16 bits");
  static_assert(kLowestSetting >= 100 && kLowestSetting + kOwnCount <= 256,
                "settings 0 to 99 belong to published firmware; 255 is the last number");
  static_assert(int(kLowestSetting) + int(kOwnCount) <= int(Next::kLowestSetting),
                "numbers rise down the list and never overlap");

  static uint16_t presentMask(const Real* parameter) {
    bool present = false;
    for (uint8_t i = 0; i < kOwnCount; ++i) present |= !isZero(parameter[i]);
    return uint16_t((present ? 1u << Index : 0u) | Next::presentMask(parameter + kOwnCount));
  }

  static void prepare(const Real* parameter, Real* c) {
    Own::prepare(parameter, kOwnCount, c);
    Next::prepare(parameter + kOwnCount, c + kOwnCount);
  }

  static void adjustLength(const Real* c, uint16_t present, Strand<Real>& strand) {
    if (present & (1u << Index)) Own::adjustLength(c, strand);
    Next::adjustLength(c + kOwnCount, present, strand);
  }

  /// Calls visitor.template effect<Own>(first setting) for each effect, in order.
  template <class Visitor>
  static void visit(Visitor& visitor) {
    visitor.template effect<Own>(int(First::kFirstSetting));
    Next::visit(visitor);
  }
};

/// The effects of a machine, applied from top to bottom.
template <class... Entries>
struct Registry {
  template <class Real>
  using For = Chain<Real, 0, Entries...>;
  enum { kEffectCount = sizeof...(Entries) };
};

}  // namespace kinematics
