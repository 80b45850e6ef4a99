// What a physical effect is: parameters, words for people, and the hooks it may act through.
#pragma once

#include <math.h>
#include <stdint.h>

#include "deep.h"
#include "strand.h"

// For hooks of effects that most machines do not have: kept out of line, they leave the board's few
// registers to the others (200 cycles an inverse); cold, they stand apart, so that the others stay
// within the reach of short calls (80 cycles).
#define PLUMB_RARE __attribute__((noinline, cold))
// For what every inverse does, though in two places.
#define PLUMB_INLINE __attribute__((always_inline)) inline

namespace kinematics {

/// The nearest whole number; a dual number brings its own.
inline int16_t nearest(float value) { return int16_t(lround(value)); }
inline int16_t nearest(double value) { return int16_t(lround(value)); }

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
/// An effect must have
///   enum { ..., kParamCount };        its parameters, which are settings
///   enum { ..., kCoefficientCount };  the numbers its hooks read, worked out by
///   static void prepare(const Frame<Real>&, const Real* parameter, Real* c);
/// once, when settings change. A hook gets these c and changes only what it is given.
///
/// Two laws hold for each effect and are tested for all: with every parameter zero no bit of any
/// length changes, and every parameter has a slope at zero.
template <class Real>
struct Effect {
  enum { kNeedsForces = 0 };  ///< 1 where a hook reads pull or bend
  enum { kMovesEnds = 0 };    ///< 1 where moveEnds does anything
  enum { kEmpirical = 0 };    ///< 1 where it is a mere fit and no cause: never a suspect

  /// Moves the sprockets' centres [mm], left and right, for good: runs once, like prepare.
  static void moveSprocket(const Real*, Point<Real>*) {}

  /// Adds to `span` [mm], for both strands, what moves the bit's end away from the sprocket's: x
  /// inward, y down. The strands it may look at are drawn without such moves, and only so far as
  /// forces need: free, sine and cosine. They are drawn again with all moves.
  static void moveEnds(const Real*, const Strand<Real>*, const Forces<Real>&, Point<Real>*) {}

  /// Changes strand.length, the free chain in nominal links; it comes in as strand.free.
  static void adjustLength(const Real*, Strand<Real>&) {}
};

}  // namespace kinematics
