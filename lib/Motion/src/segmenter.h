// Cuts a path into segments: how many ticks it takes, and where the exact inverse is asked.
#pragma once

#include "bound.h"
#include "fixed.h"
#include "path.h"
#include "segment.h"

namespace motion {

/// How a move stands, or why it does not begin.
enum class Outcome : uint8_t {
  kMoving,      ///< there are set-points to come
  kArrived,     ///< the last set-point was the path's end
  kNoPath,      ///< the path was not drawn
  kNoFeed,      ///< a step of zero, less than zero or NaN
  kTooFast,     ///< a step over kLongestStep
  kTooSlow,     ///< a path of over kMostPathTicks ticks
  kNoBound,     ///< surroundings that are negative or no numbers
  kOutOfReach,  ///< the exact inverse refused a knot; the set-points stay at the last good one
};

const float kLongestStep = 100;           // [mm] a tick, or a segment of two could overflow
const int32_t kMostPathTicks = 1L << 24;  // up to here a float counts every tick

/// A path cut into ticks of one length, and how far it is walked.
template <class Real>
struct Cutting {
  Path<Real> path;
  Outcome outcome;
  int32_t ticks;        ///< of the whole path
  int32_t done;         ///< of them, up to the last segment cut
  uint8_t per_segment;  ///< ticks of a segment, at most
};

/// The next segment, if there is one.
struct Cut {
  Segment segment;
  Outcome outcome;  ///< kMoving, or why there is none
};

namespace segmenter_detail {

/// Whether a path and a step [mm] make a move at all.
template <class Real>
Outcome judge(const Path<Real>& path, Real step, const Surroundings<Real>& around) {
  if (path.drawn != Drawn::kYes) return Outcome::kNoPath;
  if (!(step > Real(0))) return Outcome::kNoFeed;
  if (!(step <= Real(kLongestStep))) return Outcome::kTooFast;
  if (!(path.length <= step * Real(kMostPathTicks))) return Outcome::kTooSlow;
  const Slopes<Real>& effects = around.effects;
  const bool bounded = around.nearest > Real(0) && effects.first >= Real(0) &&
                       effects.second >= Real(0) && effects.third >= Real(0) &&
                       isfinite(effects.first + effects.second + effects.third);
  return bounded ? Outcome::kMoving : Outcome::kNoBound;
}

/// Ticks of a segment, at most, where each is `step` [mm] long.
template <class Real>
uint8_t ticksPerSegment(const Path<Real>& path, Real step, const Surroundings<Real>& around) {
  const Real third = thirdSlope(path.curvature(), around);
  // A short move needs no root.
  if (path.length <= Real(kLongestSegment) && missed(third, path.length) <= Real(kMostMissed))
    return kMostTicks;
  const Real allowed = longestSegment(third);
  const Real longest = allowed < Real(kLongestSegment) ? allowed : Real(kLongestSegment);
  const Real ticks = longest / step;
  if (!(ticks < Real(kMostTicks))) return kMostTicks;
  // Two ticks fall on knots, both of them, however long they are. Three would miss to one side
  // and at once to the other, a jitter of 1.5 times the bound; from four on it is once the bound.
  return ticks >= Real(4) ? uint8_t(ticks) : 2;
}

/// Exact lengths at a tick, which may be half of one.
template <class Real, class Inverse>
Reached knotAtTick(const Cutting<Real>& cutting, Real tick, const Inverse& inverse) {
  return knotAt(inverse, placeOn(cutting.path, tick / Real(cutting.ticks)));
}

}  // namespace segmenter_detail

/// Prepares a path for cutting, in ticks as long as fit evenly and no longer than `step` [mm].
template <class Real>
Cutting<Real> beginCutting(const Path<Real>& path, Real step, const Surroundings<Real>& around) {
  Cutting<Real> cutting = {path, segmenter_detail::judge(path, step, around), 0, 0, 0};
  if (cutting.outcome != Outcome::kMoving) return cutting;
  cutting.ticks = int32_t(ceil(path.length / step));
  cutting.per_segment =
      segmenter_detail::ticksPerSegment(path, path.length / Real(cutting.ticks), around);
  return cutting;
}

/// The segment after those already cut, which ended at the knot `from`; two exact inverses, or one
/// for a single tick. The cutting is to be moved on by its ticks.
template <class Real, class Inverse>
Cut cutNext(const Cutting<Real>& cutting, Knot from, const Inverse& inverse) {
  if (cutting.outcome != Outcome::kMoving) return {standing(from), cutting.outcome};
  const int32_t rest = cutting.ticks - cutting.done;
  if (rest <= 0) return {standing(from), Outcome::kArrived};
  const uint8_t ticks = rest < cutting.per_segment ? uint8_t(rest) : cutting.per_segment;
  const Real start = Real(cutting.done);
  const Reached to = segmenter_detail::knotAtTick(cutting, start + Real(ticks), inverse);
  Reached middle = to;
  // A single tick has no place between its ends, so any middle will do.
  if (ticks > 1)
    middle = segmenter_detail::knotAtTick(cutting, start + Real(ticks) * Real(0.5), inverse);
  if (to.reachable && middle.reachable && areNear(from, to.knot) && areNear(from, middle.knot))
    return {segmentThrough(from, middle.knot, to.knot, ticks), Outcome::kMoving};
  return {standing(from), Outcome::kOutOfReach};
}

}  // namespace motion
