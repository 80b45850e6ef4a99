// A physical effect: its parameters, its texts, and the hooks through which it acts.
#pragma once

#include <math.h>
#include <stdint.h>

#include "deep.h"
#include "strand.h"

// For hooks of effects that most machines do not have. Out of line, they leave the board's few
// registers to the other hooks, which saves 200 cycles an inverse. `cold` puts them apart in flash,
// so that short calls reach the other hooks, which saves 80 cycles.
#define PLUMB_RARE __attribute__((noinline, cold))
// For what every inverse does, where two places call it.
#define PLUMB_INLINE __attribute__((always_inline)) inline

namespace kinematics {

/// The nearest whole number; dual.h overloads it for dual numbers.
inline int16_t nearest(float value) { return int16_t(lround(value)); }
inline int16_t nearest(double value) { return int16_t(lround(value)); }

/// Texts about an effect, for host tools only; the firmware has none of them.
struct EffectInfo {
  const char* name;         ///< snake_case, as used in files and on screen
  const char* summary;      ///< the cause, in one sentence
  const char* pattern;      ///< what it does to marks on the sheet
  const char* look_alikes;  ///< effects with a similar pattern, separated by ", "
  const char* remedy;       ///< how to tell it apart or cure it
};

/// Texts about a parameter.
struct ParamInfo {
  const char* name;
  const char* unit;
  double low, high;  ///< physically plausible range
  double typical;    ///< size on real machines; zero always means absent
  const char* summary;
  double sigma;  ///< standard deviation of the direct check (see CheckInfo); 0: no check reads it
};

/// How a parameter is shown to a maker.
enum Shown {
  kAsIs,
  kRoot,   ///< the parameter is a square
  kAngle,  ///< the parameter is the square of a tangent; shown in degrees
};

/// A parameter's size in plain words, where # stands for the size with its unit.
struct PlainInfo {
  const char* more;  ///< above zero, like "left chain # too long"; may be empty
  const char* less;  ///< below zero; if empty, `more` with a minus sign
  const char* unit;
  double times;  ///< the size shown is this times the parameter, before its root or angle
  Shown shown;

  constexpr PlainInfo(const char* more_words, const char* less_words, const char* its_unit,
                      double factor = 1, Shown how = kAsIs)
      : more(more_words), less(less_words), unit(its_unit), times(factor), shown(how) {}
};

/// A direct measurement of an effect. Its lengths stand in both units: {1 mm|0.039 inch}.
struct CheckInfo {
  const char* title;  ///< what is measured; empty: no direct way is known
  const char* steps;  ///< what to do, and how exactly
  const char* value;  ///< how the parameters follow from what was measured
  double minutes;     ///< of work
};

/// How a parameter follows from what is read.
enum Curve {
  kStraight,
  kSquare,
  kSquareOfTangent,  ///< of degrees
};

/// Reading on a rule or a scale for a parameter, which is
/// factor * curve(read - zero) * (the sled's weight [N] to the power of kWeightPower).
struct ReadingInfo {
  const char* title;  ///< what is read; empty if it cannot be read
  const char* unit;
  double usual;  ///< how far a careful reading may be off
  double factor;
  int digits;  ///< behind the point
  double zero;
  Curve curve;

  constexpr ReadingInfo(const char* what, const char* its_unit, double off, double times,
                        int shown = 1, double start = 0, Curve how = kStraight)
      : title(what),
        unit(its_unit),
        usual(off),
        factor(times),
        digits(shown),
        zero(start),
        curve(how) {}
};

/// A machine that has the effect: the bench hides the effect, the tests compare it with the judge.
struct Example {
  const char* label;
  double size[4];  ///< of the parameters, in their units
  double most;  ///< [mm] RMS of marks that the effect causes on the worst of real machines, roughly
};

/// The published programs' setting for the same quantity.
struct PublishedInfo {
  int number;     ///< its $-number; 0: there is none
  double factor;  ///< its value is factor * parameter
};

/// The settings by which the published firmware describes chains.
template <class Real>
struct PublishedChains {
  Real sag_correction;             ///< [1/mm^2]
  Real strain[2];                  ///< [1] left and right chain
  Real sheet_width, sheet_height;  ///< [mm]
};

/// Base of all effects. Its hooks do nothing; an effect hides those that it needs.
///
/// An effect must have
///   enum { ..., kParamCount };        its parameters, which are settings
///   enum { ..., kCoefficientCount };  the numbers that its hooks read
///   static void prepare(const Frame<Real>&, const Real* parameter, Real* c);
/// prepare() works out the coefficients c when settings change. A hook gets c and changes only its
/// arguments. Of parameters that are new with each zeroing, those of the left side come first.
///
/// Two laws hold for each effect and are tested for all: with every parameter zero no bit of any
/// length changes, and every parameter has a slope at zero.
template <class Real>
struct Effect {
  // For the firmware, at compile time.
  enum { kNeedsForces = 0 };   ///< 1 where a hook reads more than Strand<Real, false>
  enum { kMovesEnds = 0 };     ///< 1 where moveEnds does anything
  enum { kPushesSled = 0 };    ///< 1 where pushSled does anything
  enum { kBends = 0 };         ///< 1 where it grows as sag does: the planner's bound measures it
  enum { kWaves = 0 };         ///< 1 where parameters are amplitudes of a wave per sprocket turn
  enum { kClientNumber = 0 };  ///< number by which a published client means the first parameter

  // For the lab only.
  enum { kEmpirical = 0 };    ///< 1 where it is a fit without a cause: never a suspect
  enum { kPerZeroing = 0 };   ///< 1 where it is new each time the chains are set to zero
  enum { kInFrame = 0 };      ///< 1 where a refitted frame or a turned sheet draws nearly the same
  enum { kWeightPower = 0 };  ///< parameters are proportional to this power of the sled's weight
  enum { kExampleCount = 1 };
  enum { kChainMicrometres = 6 };  ///< of chain: most that it may differ from the judge
  enum { kBitMicrometres = 8 };    ///< the same at the bit, under low and high motors

  /// Moves the sprockets' centres [mm], left and right, for good: runs once, like prepare.
  static void moveSprocket(const Real*, Point<Real>*) {}

  /// Adds to `push` [1], in sled weights, what pushes a sled at `bit` [mm]: x right, y up.
  static void pushSled(const Real*, Point<Real>, Point<Real>&) {}

  /// Adds to `span` [mm], for both strands, what moves the bit's end away from the sprocket's: x
  /// inward, y down. The strands that the hook reads are drawn without such moves. They have only
  /// what forces need: free, sine and cosine. Later they are drawn again with all moves.
  template <class SomeForces>
  static void moveEnds(const Real*, const Strand<Real>*, const SomeForces&, Point<Real>*) {}

  /// Changes strand.length, the free chain in nominal links [mm], which starts as strand.free.
  static void adjustLength(const Real*, Strand<Real, false>&) {}

  /// Adds to the parameters what the published settings say of this effect.
  static void addPublished(const Frame<Real>&, const PublishedChains<Real>&, Real*) {}

  /// The size to expect on a machine with this frame; 0: many machines are without the effect.
  static double usual(const Frame<Real>&, uint8_t) { return 0; }

  /// The published programs' setting for parameter i.
  static PublishedInfo published(uint8_t) { return {0, 0}; }

  /// The effect's name in plain words, a noun; if empty, screens show `name`.
  static const char* noun() { return ""; }

  /// Parameter i in plain words.
  static PlainInfo plain(uint8_t) { return {"", "", ""}; }

  // Every effect must hide these two and setJudge (see judged.h); a test checks that.
  static CheckInfo check() { return {nullptr, nullptr, nullptr, 0}; }
  static ReadingInfo reading(uint8_t) { return {"", "", 0, 0}; }
  static Example example(uint8_t) { return {nullptr, {0, 0, 0, 0}, 0}; }
  template <class Judge>
  static void setJudge(const Frame<Real>&, const Real*, Judge&) {}
};

}  // namespace kinematics
