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
struct Listed;

/// End of the list.
template <class Real, uint8_t Index>
struct Listed<Real, Index> {
  enum {
    kParamCount = 0,
    kCoefficientCount = 0,
    kLowestSetting = 256,
    kForceMask = 0,
    kMoveMask = 0
  };
  static uint16_t presentMask(const Real*) { return 0; }
  static void prepare(const Frame<Real>&, const Real*, Real*) {}
  static void moveSprocket(const Real*, uint16_t, Point<Real>*) {}
  static void moveEnds(const Real*, uint16_t, const Strand<Real>*, const Forces<Real>&,
                       Point<Real>*) {}
  static void adjustLength(const Real*, uint16_t, Strand<Real>&) {}
  static int indexOf(int) { return -1; }
  template <class Visitor>
  static void visit(Visitor&) {}
};

template <class Real, uint8_t Index, class First, class... Rest>
struct Listed<Real, Index, First, Rest...> {
  typedef typename First::template Type<Real> Own;
  typedef Listed<Real, Index + 1, Rest...> Next;
  enum {
    kOwnCount = Own::kParamCount,
    kParamCount = kOwnCount + Next::kParamCount,
    kOwnCoefficients = Own::kCoefficientCount,
    kCoefficientCount = kOwnCoefficients + Next::kCoefficientCount,
    kLowestSetting = First::kFirstSetting,
    kForceMask = (Own::kNeedsForces << Index) | Next::kForceMask,
    kMoveMask = (Own::kMovesEnds << Index) | Next::kMoveMask
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

  static void prepare(const Frame<Real>& frame, const Real* parameter, Real* c) {
    Own::prepare(frame, parameter, c);
    Next::prepare(frame, parameter + kOwnCount, c + kOwnCoefficients);
  }

  static void moveSprocket(const Real* c, uint16_t present, Point<Real>* sprocket) {
    if (present & (1u << Index)) Own::moveSprocket(c, sprocket);
    Next::moveSprocket(c + kOwnCoefficients, present, sprocket);
  }

  static void moveEnds(const Real* c, uint16_t present, const Strand<Real>* strand,
                       const Forces<Real>& forces, Point<Real>* span) {
    if (present & (1u << Index)) Own::moveEnds(c, strand, forces, span);
    Next::moveEnds(c + kOwnCoefficients, present, strand, forces, span);
  }

  static void adjustLength(const Real* c, uint16_t present, Strand<Real>& strand) {
    if (present & (1u << Index)) Own::adjustLength(c, strand);
    Next::adjustLength(c + kOwnCoefficients, present, strand);
  }

  /// Where the parameter with that $-setting stands among all parameters, or -1.
  static int indexOf(int setting) {
    const int own = setting - First::kFirstSetting;
    if (own >= 0 && own < kOwnCount) return own;
    const int next = Next::indexOf(setting);
    return next < 0 ? next : kOwnCount + next;
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
  using For = Listed<Real, 0, Entries...>;
  enum { kEffectCount = sizeof...(Entries) };
};

}  // namespace kinematics
