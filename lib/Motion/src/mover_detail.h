// The function bodies of mover.h: segments between exact knots at even times, and single ticks
// where moves meet.
//
// Invariants, after each set-point (test_invariants.cpp):
//  1. The walk is on the first move: from 0 to its length, at a speed that is not negative. Without
//     moves it is at 0 and rests.
//  2. In the next tick the sled can brake by its acceleration, and go on braking to the speed that
//     is allowed at the move's end. After a tick that crossed a corner half the acceleration of the
//     move before may be missing. A feed that is lowered may break this until the next rest.
//  3. No move ends faster than the next may go.
//  4. A set-point is no farther from the set-point before it than its leg's way; the way is 1 to
//     2^17 - 1 counts, the gain at least 1.
//  5. The last set-point is the last move's end, to the count.
#pragma once

#include "mover.h"

namespace motion {

// At least this many set-points must wait before the mover asks for nine inverses at once.
enum : uint8_t { kEnoughWait = 8 };

inline void Mover::forget() {
  queue_.clear();
  walk_ = {0, 0};
  z_end_ = toMm<float>(last_.z);
  is_taken_up_ = false;
  standStill();
}

inline void Mover::standAt(const SetPoint& point) {
  last_ = point;
  awaits_z_ = false;
  forget();
}

inline Added Mover::add(const Path<float>& path, float z_to, float feed, Space space, uint8_t beam,
                        bool is_rapid) {
  if (queue_.isEmpty()) z_from_ = z_end_;
  const Added added = queue_.add(path, z_end_, z_to, feed, space, beam, is_rapid);
  if (added != Added::kYes) return added;
  z_end_ = z_to;
  // The speed may be falling to a stop only because this move was missing.
  if (change_ < 0) cutShort();
  return added;
}

inline Walk Mover::walk() const {
  if (segment_.ticks_left == 0) return walk_;
  return after(begun_, change_, uint8_t(ticks_ - segment_.ticks_left));
}

/// Ends the segment in progress at its last set-point.
inline void Mover::cutShort() {
  walk_ = walk();
  standStill();
}

inline void Mover::boost(float times, float most_feed, float rapid) {
  queue_.boost(times, most_feed, rapid);
  if (queue_.isEmpty()) return;
  cutShort();
  is_taken_up_ = false;
}

inline void Mover::dropFirst() {
  if (has_z_) last_.z = toCounts(queue_.first().z_to);
  z_from_ = queue_.first().z_to;
  queue_.dropFirst();
  has_z_ = queue_.first().z_to != z_from_;
  is_taken_up_ = false;
}

/// How many ticks a segment of the first move may have.
inline void Mover::takeUp() {
  const Move& move = queue_.first();
  is_taken_up_ = true;
  has_z_ = move.z_to != z_from_;
  const int32_t gain = toCounts(move.acceleration);
  feed_way_ = toCounts(move.feed);
  beam_ = move.beam;
  gain_ = gain < 1 ? 1 : gain > 65535 ? 65535 : uint16_t(gain);
  // A move whose feed was lowered is faster than its top for a while.
  const float top = move.top > walk_.speed ? move.top : walk_.speed;
  // In a segment of two ticks both set-points are knots.
  const float kShort = 5;  // [ticks]
  even_ticks_ = uneven_ticks_ = move.space == Space::kEdge ? 1 : 2;
  if (move.length < kShort * top && move.space == Space::kSheet) return;
  if (move.space == Space::kEdge) return;
  // Within this many ticks the ends of a segment are near (kMostRise).
  const float longest = kLongestSegment / top;
  float even = longest, uneven = longest;
  if (move.path.length > 0 && move.space == Space::kSheet) {
    const Surroundings<float> around = surroundingsOf(move.path, queue_.sprockets());
    const float share = move.path.length / move.length, speed = top * share;
    const float third = thirdSlope(move.path.curvature(), around);
    const float second = secondSlope(move.path.curvature(), around);
    even = queue_detail::smaller(even, longestTime(third, second, speed, 0.0f));
    uneven =
        queue_detail::smaller(uneven, longestTime(third, second, speed, move.acceleration * share));
  }
  // With three ticks the error would change sign from a tick to the next: 1.5 times the bound in a
  // step.
  even_ticks_ = !(even >= 4) ? 2 : stretch_detail::atMost(even, kMostTicks);
  uneven_ticks_ = !(uneven >= 4) ? 2 : stretch_detail::atMost(uneven, kMostTicks);
}

/// z [counts] after `done` [mm] of the first move.
inline int32_t Mover::zAt(const Move& move, float done) const {
  if (!has_z_) return last_.z;
  const float share = done / move.length;
  return toCounts(share >= 1 ? move.z_to : z_from_ + (move.z_to - z_from_) * share);
}

/// Exact chain lengths at a point of the first move.
template <class Inverse>
Reached Mover::exactlyAt(const Walk& walk, const Inverse& inverse) const {
  const Move& move = queue_.first();
  if (move.path.length == 0) return {{last_.left, last_.right}, true};
  const Point<float> place = placeOn(move.path, walk.done / move.length);
  if (move.space != Space::kChains) return knotAt(inverse, place);
  return {{toCounts(place.x), toCounts(place.y)}, true};
}

/// Chain lengths at a point between the ends, where short moves may share exact places.
template <class Inverse>
Reached Mover::lengthsAt(const Walk& walk, const Inverse& inverse) {
  const Move& move = queue_.first();
  // A longer move has segments of many ticks, which need fewer knots than a tile.
  const float kShort = 1.5f;  // [mm]
  const bool shares =
      move.space == Space::kSheet && move.path.length > 0 && move.path.length <= kShort;
  if (!shares) return exactlyAt(walk, inverse);
  const Point<float> place = placeOn(move.path, walk.done / move.length);
  return tiles_.lengthsAt(place, move.path, queue_.sprockets(), inverse);
}

/// Begins a segment of several ticks, all within the first move.
template <class Inverse>
bool Mover::begin(const Stretch& stretch, const Inverse& inverse) {
  const Move& move = queue_.first();
  const Walk to = after(walk_, stretch.change, stretch.ticks);
  const float half = 0.5f * float(stretch.ticks);
  const Walk middle = {walk_.done + half * (walk_.speed + 0.5f * stretch.change * (half + 1)), 0};
  const Reached end = lengthsAt(to, inverse), between = lengthsAt(middle, inverse);
  const Knot from = {last_.left, last_.right};
  if (!end.reachable || !between.reachable || !areNear(from, end.knot)) return false;
  if (!areNear(from, between.knot)) return false;
  segment_ = segmentThrough(from, between.knot, end.knot, stretch.ticks);
  if (has_z_)
    z_steps_ = stepsThrough(last_.z, zAt(move, middle.done), zAt(move, to.done), stretch.ticks);
  way_ = toCounts(walk_.speed);
  way_change_ = toCounts(stretch.change);
  begun_ = walk_;
  walk_ = to;
  change_ = stretch.change;
  ticks_ = stretch.ticks;
  return true;
}

/// Drops the first move; what the walk went beyond its end belongs to the next move.
template <class Inverse>
bool Mover::pass(const Inverse& inverse) {
  const float length = queue_.first().length;
  if (queue_.second().path.length == 0) {
    // While z moves alone the chains stand still, so they must be exact here.
    const Reached end = exactlyAt({length, 0}, inverse);
    if (!end.reachable) return false;
    last_.left = end.knot.left;
    last_.right = end.knot.right;
  }
  walk_.done = walk_.done > length ? walk_.done - length : 0;
  // At a corner with a stop the next move begins at rest.
  if (queue_.exitSquared() == 0) {
    walk_ = {0, 0};
    awaits_z_ = isOfZ();
  }
  dropFirst();
  return true;
}

/// A single tick, which may lead into later moves or to the end of all moves.
template <class Inverse>
bool Mover::step(float change, const Inverse& inverse) {
  walk_.speed += change;
  walk_.done += walk_.speed;
  way_ = toCounts(walk_.speed);
  change_ = 0;
  // A remainder that comes from rounding is not worth a tick.
  const float kHair = 1 - 1e-6f;
  while (walk_.done >= queue_.first().length * kHair && queue_.count() > 1) {
    if (queue_.second().beam < beam_) beam_ = queue_.second().beam;
    if (!pass(inverse)) return false;
  }
  const Move& move = queue_.first();
  const bool arrives = walk_.done >= move.length * kHair;
  if (arrives) walk_ = {move.length, 0};
  const Reached here = arrives ? exactlyAt(walk_, inverse) : lengthsAt(walk_, inverse);
  if (!here.reachable) return false;
  last_ = {here.knot.left, here.knot.right, zAt(move, walk_.done)};
  if (arrives) {
    awaits_z_ = isOfZ();
    // z as it was commanded, not as counts round it.
    const float z_end = z_end_;
    forget();
    z_end_ = z_end;
  }
  return true;
}

/// Goes on when no segment is in progress: begins the next segment, or takes a single tick. False:
/// no sled can hang there, and the last set-point stays.
template <class Inverse>
bool Mover::cut(const Inverse& inverse) {
  if (!is_taken_up_) takeUp();
  const Move& move = queue_.first();
  const Bounds bounds = {move.length - walk_.done, move.top,    move.acceleration,
                         queue_.exitSquared(),     even_ticks_, uneven_ticks_};
  const Stretch stretch = nextStretch(walk_.speed, bounds);
  if (stretch.ticks < 2) return step(stretch.change, inverse);
  return begin(stretch, inverse);
}

/// The next set-point of the segment in progress.
inline void Mover::advance() {
  segment_.advance();
  way_ += way_change_;
  last_.left = segment_.left.length.whole;
  last_.right = segment_.right.length.whole;
  if (has_z_) {
    z_steps_.advance();
    last_.z = z_steps_.length.whole;
  }
}

inline void Mover::push(SetPoints& set_points) const {
  const int32_t kMostWay = (1L << 17) - 1;
  Leg& leg = set_points.vacant();
  copy(last_, leg.to);
  leg.way = way_ < 1 ? 1 : way_ > kMostWay ? kMostWay : uint32_t(way_);
  leg.gain = gain_;
  leg.beam = beam_ == 0 ? uint8_t(0) : beamNow();
  set_points.push();
}

template <class Inverse>
Filled Mover::fill(SetPoints& set_points, const Inverse& inverse, bool is_z_near) {
  // The axes stood still while they waited, so they must speed up from rest.
  if (set_points.hasRunDry() && walk().speed != 0) {
    if (times_dry_ != UINT16_MAX) ++times_dry_;
    cutShort();
    walk_.speed = 0;
  }
  while (!queue_.isEmpty() && set_points.hasRoom()) {
    if (awaits_z_ && !is_z_near) return Filled::kYes;
    awaits_z_ = false;
    bool rests = false;
    if (segment_.ticks_left == 0) {
      rests = walk_.speed == 0;
      tiles_.setTime(rests || set_points.count() >= kEnoughWait);
      if (!cut(inverse)) return Filled::kOutOfReach;
    }
    // Each is called here alone, so that the compiler puts them in place.
    if (segment_.ticks_left != 0) advance();
    push(set_points);
    // While nothing moved the ring was empty as it should be: clear that mark.
    if (rests) set_points.hasRunDry();
  }
  return Filled::kYes;
}

}  // namespace motion
