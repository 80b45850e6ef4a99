// A piece of a path between exact knots: two additions a tick give its set-points, without drift.
#pragma once

#include <stdint.h>

#include "fixed.h"

namespace motion {

// Most ticks of a segment. With more, rounding of the last bit would add up (see stepsThrough).
enum : uint8_t { kMostTicks = 181 };
static_assert(1L * kMostTicks * kMostTicks <= 32767L, "the square must be a divisor of divide()");

// Knots of a segment are nearer than this [counts], or the sums below could overflow.
const int32_t kMostRise = 512 * kCountsPerMm;
const float kLongestSegment = 256;  // [mm] of path; its knots are then near enough

/// Counts with 16 more binary digits, 2^-32 mm: whole + fraction / 65536.
struct Fine {
  int32_t whole;      ///< [counts]
  uint16_t fraction;  ///< [counts / 65536]
};

// always_inline, for add() and advance(): every tick adds four times, and calls would add half to
// the time.

/// Adds `more` to `sum`.
__attribute__((always_inline)) inline void add(Fine& sum, const Fine& more) {
  const uint16_t fraction = uint16_t(sum.fraction + more.fraction);
  int32_t whole = sum.whole + more.whole;
  // A branch: the board carries a bit from 16 to 32 bits no faster without it.
  if (fraction < more.fraction) ++whole;
  sum.whole = whole;
  sum.fraction = fraction;
}

/// A fine number less another.
inline Fine differenceOf(const Fine& from, const Fine& less) {
  const bool borrow = from.fraction < less.fraction;
  return {from.whole - less.whole - borrow, uint16_t(from.fraction - less.fraction)};
}

/// Counts / divisor, rounded down to 2^-16 counts, whatever the sign; divisors up to 32767.
inline Fine divide(int32_t counts, uint16_t divisor) {
  int32_t whole = counts / int32_t(divisor);
  int32_t rest = counts % int32_t(divisor);
  if (rest < 0) {
    rest += int32_t(divisor);
    --whole;
  }
  return {whole, uint16_t((uint32_t(rest) << 16) / divisor)};
}

/// A fine number times factor / 2, rounded down.
inline Fine timesHalf(const Fine& number, uint8_t factor) {
  const uint32_t low = uint32_t(number.fraction) * factor;
  const int32_t whole = number.whole * factor + int32_t(low >> 16);
  const uint16_t odd = whole & 1 ? 0x8000 : 0;
  return {whole >> 1, uint16_t(uint16_t(uint16_t(low) >> 1) | odd)};
}

/// A chain's length through a segment of n ticks: a quadratic through three exact lengths.
///
/// With bend = 2 * (from - 2 middle + to), the quadratic's second difference is 2 * bend / n^2. The
/// first difference that leads to the end is (to - from) / n - second * (n - 1) / 2.
struct Steps {
  Fine length;  ///< the set-point now plus half a count: its whole part is then rounded
  Fine first;   ///< what the next tick adds to `length`
  Fine second;  ///< what each tick adds to `first`

  /// Takes the next tick.
  __attribute__((always_inline)) void advance() {
    add(length, first);
    add(first, second);
  }
};

/// The quadratic between two lengths [counts] in n ticks, through `middle` at half time.
///
/// It meets the end to the count: `first` is worked out from the rounded `second`, so only the last
/// digit of `first` is off, and n of those are less than 0.006 counts. In between, `second` is too
/// small by less than a last digit: n^2 / 8 of those are 0.06 counts.
inline Steps stepsThrough(int32_t from, int32_t middle, int32_t to, uint8_t ticks) {
  const int32_t rise = to - from;
  const int32_t bend = 2 * rise - 4 * (middle - from);
  const Fine second = divide(2 * bend, uint16_t(uint16_t(ticks) * ticks));
  const Fine first = differenceOf(divide(rise, ticks), timesHalf(second, uint8_t(ticks - 1)));
  return {{from, 0x8000}, first, second};
}

/// Both chains between two knots.
struct Segment {
  Steps left, right;
  uint8_t ticks_left;  ///< set-points still to come

  /// Takes the next tick; after the last tick the set-points are exactly the end's knot.
  void advance() {
    left.advance();
    right.advance();
    --ticks_left;
  }
};

/// A segment that stands still.
inline Segment standing(Knot at) {
  const Fine none = {0, 0};
  return {{{at.left, 0}, none, none}, {{at.right, 0}, none, none}, 0};
}

/// The segment through three knots, `middle` at half time, in 1 to kMostTicks ticks.
inline Segment segmentThrough(Knot from, Knot middle, Knot to, uint8_t ticks) {
  return {stepsThrough(from.left, middle.left, to.left, ticks),
          stepsThrough(from.right, middle.right, to.right, ticks), ticks};
}

/// Whether two knots are near enough for a segment.
inline bool areNear(Knot from, Knot to) {
  const int32_t left = from.left - to.left, right = from.right - to.right;
  return left < kMostRise && left > -kMostRise && right < kMostRise && right > -kMostRise;
}

}  // namespace motion
