// What a physical effect is: parameters, words for people, and the hooks it may act through.
#pragma once

#include <stdint.h>

#include "strand.h"

namespace kinematics {

/// What people are told of an effect. Only host tools ask; no such text reaches the board.
struct EffectInfo {
  const char* name;         ///< snake_case, the word used in files and on screen
  const char* summary;      ///< the cause, in one sentence
  const char* pattern;      ///< what it does to marks on the sheet
  const char* look_alikes;  ///< effects with a similar pattern, separated by ", "
  const char* remedy;       ///< how to tell it apart or cure it
};

/// What people are told of one parameter.
struct ParamInfo {
  const char* name;
  const char* unit;
  double low, high;  ///< physically plausible range
  double typical;    ///< size met on real machines; zero always means absent
  const char* summary;
};

/// Base of all effects: every hook does nothing until an effect hides it with its own.
///
/// A hook gets the effect's coefficients c (see prepare) and changes only what it is given.
/// Two laws hold for each effect and are tested for all: with every parameter zero no bit of any
/// length changes, and every parameter has a slope at zero.
template <class Real>
struct Effect {
  enum { kNeedsForces = 0 };  ///< 1 where a hook reads tension or bend

  /// Turns parameters into the coefficients the hooks read; runs once, when settings change.
  /// Coefficients are as many as parameters, and zero exactly where the parameter is.
  static void prepare(const Real* parameter, uint8_t count, Real* c) {
    for (uint8_t i = 0; i < count; ++i) c[i] = parameter[i];
  }

  /// Changes strand.extra; the free chain is strand.free + strand.extra long so far.
  static void adjustLength(const Real*, Strand<Real>&) {}
};

}  // namespace kinematics
