// Follows one path after the other: both chains' set-points, one pair each control tick.
#pragma once

#include "segmenter.h"

namespace motion {

/// Both chains on their way along a path at constant feed.
template <class Real>
class PathFollower {
 public:
  /// Stands still with these lengths paid out; knotAt() tells those of a place.
  explicit PathFollower(Knot at) : segment_(standing(at)), cutting_() {
    cutting_.outcome = Outcome::kArrived;
  }

  /// Takes up a path that begins where the last one ended, in steps of at most `step` [mm] a tick.
  /// kMoving, or why the path is not taken up.
  Outcome follow(const Path<Real>& path, Real step, const Surroundings<Real>& around) {
    segment_ = standing(segment_.at());
    cutting_ = beginCutting(path, step, around);
    return cutting_.outcome;
  }

  /// Moves the set-points on by one control tick. kMoving: they are new; otherwise they stay.
  template <class Inverse>
  Outcome tick(const Inverse& inverse) {
    if (segment_.ticks_left == 0) {
      const Outcome outcome = takeUpSegment(inverse);
      if (outcome != Outcome::kMoving) return outcome;
    }
    segment_.advance();
    return Outcome::kMoving;
  }

  /// Both chains' lengths that the motors shall have paid out now.
  Knot setPoints() const { return segment_.at(); }

 private:
  // Not inline: every tick would save the registers that only a new segment needs.
  template <class Inverse>
  __attribute__((noinline)) Outcome takeUpSegment(const Inverse& inverse) {
    const Cut cut = cutNext(cutting_, segment_.at(), inverse);
    cutting_.outcome = cut.outcome;
    if (cut.outcome != Outcome::kMoving) return cut.outcome;
    segment_ = cut.segment;
    cutting_.done += cut.segment.ticks_left;
    return Outcome::kMoving;
  }

  Segment segment_;
  Cutting<Real> cutting_;
};

}  // namespace motion
