// A list of effects, unrolled by the compiler: no virtual call, no heap, no start-up code.
#pragma once

#include <math.h>
#include <stdint.h>

#include "effect.h"

namespace kinematics {

/// A line of the registry: an effect and the number of its first $-setting. Once released, a number
/// never changes its meaning.
template <int FirstSetting, template <class> class EffectTemplate>
struct At {
  enum { kFirstSetting = FirstSetting };
  template <class Real>
  using Type = EffectTemplate<Real>;
};

/// Whether two types are the same.
template <class A, class B>
struct Same {
  enum { kYes = 0 };
};
template <class A>
struct Same<A, A> {
  enum { kYes = 1 };
};

/// True where a number is exactly zero; dual.h overloads it to look at slopes too.
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
  typedef typename First::template Type<Real> ThisEffect;
  typedef Listed<Real, Index + 1, Rest...> Next;
  enum {
    kThisCount = ThisEffect::kParamCount,
    kParamCount = kThisCount + Next::kParamCount,
    kTheseCoefficients = ThisEffect::kCoefficientCount,
    kCoefficientCount = kTheseCoefficients + Next::kCoefficientCount,
    kLowestSetting = First::kFirstSetting,
    kForceMask = (ThisEffect::kNeedsForces << Index) | Next::kForceMask,
    kMoveMask = (ThisEffect::kMovesEnds << Index) | Next::kMoveMask,
    kPushMask = (ThisEffect::kPushesSled << Index) | Next::kPushMask
  };
  static_assert(Index < 16, "the mask of present effects has 16 bits");
  static_assert(kLowestSetting >= 100 && kLowestSetting + kThisCount <= 256,
                "settings 0 to 99 belong to published firmware; 255 is the last number");
  static_assert(int(kLowestSetting) + int(kThisCount) <= int(Next::kLowestSetting),
                "numbers rise down the list and never overlap");

  static uint16_t presentMask(const Real* parameter) {
    bool present = false;
    for (uint8_t i = 0; i < kThisCount; ++i) present |= !isZero(parameter[i]);
    return uint16_t((present ? 1u << Index : 0u) | Next::presentMask(parameter + kThisCount));
  }

  static void prepare(const Frame<Real>& frame, const Real* parameter, Real* c) {
    ThisEffect::prepare(frame, parameter, c);
    Next::prepare(frame, parameter + kThisCount, c + kTheseCoefficients);
  }

  static void moveSprocket(const Real* c, uint16_t present, Point<Real>* sprocket) {
    if (present & (1u << Index)) ThisEffect::moveSprocket(c, sprocket);
    Next::moveSprocket(c + kTheseCoefficients, present, sprocket);
  }

  static void pushSled(const Real* c, uint16_t present, Point<Real> bit, Point<Real>& push) {
    if (present & (1u << Index)) ThisEffect::pushSled(c, bit, push);
    Next::pushSled(c + kTheseCoefficients, present, bit, push);
  }

  template <class SomeForces>
  static void moveEnds(const Real* c, uint16_t present, const Strand<Real>* strand,
                       const SomeForces& forces, Point<Real>* span) {
    if (present & (1u << Index)) ThisEffect::moveEnds(c, strand, forces, span);
    Next::moveEnds(c + kTheseCoefficients, present, strand, forces, span);
  }

  static void adjustLength(const Real* c, uint16_t present, Strand<Real>& strand) {
    // No more than is worked out: a hook that reads a direction without kNeedsForces does not
    // compile.
    Strand<Real, bool(ThisEffect::kNeedsForces)>& given = strand;
    if (present & (1u << Index)) ThisEffect::adjustLength(c, given);
    Next::adjustLength(c + kTheseCoefficients, present, strand);
  }

  /// Adds what the published settings say to the parameters.
  static void addPublished(const Frame<Real>& frame, const PublishedChains<Real>& published,
                           Real* parameter) {
    ThisEffect::addPublished(frame, published, parameter);
    Next::addPublished(frame, published, parameter + kThisCount);
  }

  /// Zeroes the parameters of all effects that grow as sag does.
  static void clearBends(Real* parameter) {
    for (uint8_t i = 0; ThisEffect::kBends && i < kThisCount; ++i) parameter[i] = Real(0);
    Next::clearBends(parameter + kThisCount);
  }

  /// [mm] amplitudes of all waves that follow the sprockets' turn, added up.
  static Real wavesOf(const Real* parameter) {
    Real sum = Next::wavesOf(parameter + kThisCount);
    for (uint8_t i = 0; ThisEffect::kWaves && i < kThisCount; ++i) sum += Real(fabs(parameter[i]));
    return sum;
  }

  /// The $-setting that a published client means by this number.
  static uint8_t meantBy(uint8_t number) {
    if (ThisEffect::kClientNumber != 0 && number == ThisEffect::kClientNumber)
      return uint8_t(First::kFirstSetting);
    return Next::meantBy(number);
  }

  /// Index of an effect's first parameter among all parameters.
  template <class Wanted>
  static uint8_t firstOf() {
    return Same<Wanted, ThisEffect>::kYes ? 0
                                          : uint8_t(kThisCount + Next::template firstOf<Wanted>());
  }

  /// Index of the parameter with that $-setting among all parameters, or -1.
  static int indexOf(int setting) {
    const int place = setting - First::kFirstSetting;
    if (place >= 0 && place < kThisCount) return place;
    const int next = Next::indexOf(setting);
    return next < 0 ? next : kThisCount + next;
  }

  /// Calls visitor.template effect<ThisEffect>(first setting) for each effect, in order.
  template <class Visitor>
  static void visit(Visitor& visitor) {
    visitor.template effect<ThisEffect>(int(First::kFirstSetting));
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
