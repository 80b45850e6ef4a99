// A list of effects, unrolled by the compiler: no virtual call, no heap, no start-up code.
#pragma once

#include <math.h>
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

/// Whether two types are the same one.
template <class A, class B>
struct Same {
  enum { kYes = 0 };
};
template <class A>
struct Same<A, A> {
  enum { kYes = 1 };
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
    kMoveMask = 0,
    kPushMask = 0
  };
  static uint16_t presentMask(const Real*) { return 0; }
  static void prepare(const Frame<Real>&, const Real*, Real*) {}
  static void moveSprocket(const Real*, uint16_t, Point<Real>*) {}
  static void pushSled(const Real*, uint16_t, Point<Real>, Point<Real>&) {}
  template <class SomeForces>
  static void moveEnds(const Real*, uint16_t, const Strand<Real>*, const SomeForces&,
                       Point<Real>*) {}
  static void adjustLength(const Real*, uint16_t, Strand<Real>&) {}
  static void addPublished(const Frame<Real>&, const PublishedChains<Real>&, Real*) {}
  static void clearBends(Real*) {}
  static Real wavesOf(const Real*) { return Real(0); }
  static int indexOf(int) { return -1; }
  static uint8_t meantBy(uint8_t number) { return number; }
  template <class Wanted>
  static uint8_t firstOf() {
    return 0;
  }
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
    kMoveMask = (Own::kMovesEnds << Index) | Next::kMoveMask,
    kPushMask = (Own::kPushesSled << Index) | Next::kPushMask
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

  static void pushSled(const Real* c, uint16_t present, Point<Real> bit, Point<Real>& push) {
    if (present & (1u << Index)) Own::pushSled(c, bit, push);
    Next::pushSled(c + kOwnCoefficients, present, bit, push);
  }

  template <class SomeForces>
  static void moveEnds(const Real* c, uint16_t present, const Strand<Real>* strand,
                       const SomeForces& forces, Point<Real>* span) {
    if (present & (1u << Index)) Own::moveEnds(c, strand, forces, span);
    Next::moveEnds(c + kOwnCoefficients, present, strand, forces, span);
  }

  static void adjustLength(const Real* c, uint16_t present, Strand<Real>& strand) {
    if (present & (1u << Index)) Own::adjustLength(c, strand);
    Next::adjustLength(c + kOwnCoefficients, present, strand);
  }

  /// Adds what the published settings say to the parameters.
  static void addPublished(const Frame<Real>& frame, const PublishedChains<Real>& published,
                           Real* parameter) {
    Own::addPublished(frame, published, parameter);
    Next::addPublished(frame, published, parameter + kOwnCount);
  }

  /// Zeroes the parameters of all that grows as sag does.
  static void clearBends(Real* parameter) {
    for (uint8_t i = 0; Own::kBends && i < kOwnCount; ++i) parameter[i] = Real(0);
    Next::clearBends(parameter + kOwnCount);
  }

  /// [mm] amplitudes of all waves that follow the sprockets' turn, added up.
  static Real wavesOf(const Real* parameter) {
    Real sum = Next::wavesOf(parameter + kOwnCount);
    for (uint8_t i = 0; Own::kWaves && i < kOwnCount; ++i) sum += Real(fabs(parameter[i]));
    return sum;
  }

  /// The $-setting that a published client means by this number.
  static uint8_t meantBy(uint8_t number) {
    if (Own::kClientNumber != 0 && number == Own::kClientNumber)
      return uint8_t(First::kFirstSetting);
    return Next::meantBy(number);
  }

  /// Where the first parameter of one effect stands among all parameters.
  template <class Wanted>
  static uint8_t firstOf() {
    return Same<Wanted, Own>::kYes ? 0 : uint8_t(kOwnCount + Next::template firstOf<Wanted>());
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
