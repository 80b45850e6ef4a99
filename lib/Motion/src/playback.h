// How the control tick follows the planned path: at the planned speed, slower, or not at all.
#pragma once

#include <stdint.h>

#include "set_points.h"

namespace motion {

/// Takes a set-point from the ring each tick. It can brake, hold, or go at a share of the planned
/// speed, always along the planned path and without delay.
///
/// While it is slower than planned it is between two set-points of the ring. Each tick it goes on
/// at its present speed, which changes by at most the path's acceleration. So a hold needs a way of
/// v^2 / 2a, however much the ring holds. It is never faster than planned, so corners and chain
/// speeds keep their limits. Only next() is for the control tick; the main program calls the rest
/// while it keeps the tick off.
class Playback {
 public:
  enum : uint16_t { kAllOfIt = 256 };  ///< the share for the full planned speed

  /// Brakes and stays until resume().
  void hold() { is_held_ = true; }
  void resume() { is_held_ = false; }
  /// From now on goes at `share` 256ths of the planned speed, 1 to 256.
  void goAt(uint16_t share) {
    asked_ = share;
    share_ = uint16_t(uint32_t(asked_) * yield_ >> 8);
  }
  /// Slows down to `share` 256ths of that speed, because the axes cannot follow.
  void yieldTo(uint16_t share) {
    if (share == yield_) return;
    yield_ = share;
    goAt(asked_);
  }

  bool isAtRest() const { return speed_ == 0; }
  /// Whether the last set-point taken has been reached.
  bool isDone() const { return in_step_; }

  /// Drops what was taken: the axes stand.
  void reset() {
    in_step_ = true;
    speed_ = 0;
  }

  /// The next tick's set-point; false: the axes stay where they are.
  bool next(SetPoints& ring, SetPoint& now) {
    if (in_step_) {
      if (!is_held_ && share_ == kAllOfIt) return takeNext(ring, now);
      if (speed_ == 0 && (is_held_ || ring.isEmpty())) return false;
    }
    return walk(ring, now);
  }

  /// The step of the axes `ticks` ahead, or the last step that is known.
  SetPoint stepAhead(const SetPoints& ring, uint8_t ticks) const {
    const SetPoint *from = &from_, *to = &leg_.to;
    if (in_step_) {
      if (speed_ == 0 || !ring.stepAhead(ticks, from, to)) return {0, 0, 0};
      return {to->left - from->left, to->right - from->right, to->z - from->z};
    }
    const uint32_t lost = uint32_t(leg_.gain) * ticks;
    const uint32_t speed = !is_held_ ? speed_ : speed_ > lost ? speed_ - lost : 0;
    const int32_t share = int32_t(shareOf(speed, leg_.way));
    return {(to->left - from->left) * share >> kShareBits,
            (to->right - from->right) * share >> kShareBits,
            (to->z - from->z) * share >> kShareBits};
  }

  /// Strength of the beam now: the leg's beam times the share of its planned speed.
  uint8_t beam() const {
    if (in_step_) return speed_ == 0 ? 0 : leg_.beam;
    if (speed_ >= leg_.way) return leg_.beam;
    const uint32_t kHalf = 1UL << (kShareBits - 1);
    return uint8_t((leg_.beam * shareOf(speed_, leg_.way) + kHalf) >> kShareBits);
  }

 private:
  enum : uint8_t { kShareBits = 12 };

  /// `part` over `way` in 4096ths; both are less than 2^17 counts.
  static uint32_t shareOf(uint32_t part, uint32_t way) { return (part << kShareBits) / way; }

  bool takeNext(SetPoints& ring, SetPoint& now) {
    if (!ring.take(leg_)) {
      speed_ = 0;
      return false;
    }
    copy(leg_.to, now);
    speed_ = leg_.way;
    return true;
  }

  /// Takes the first leg of a path from rest.
  void begin(SetPoints& ring, const SetPoint& now) {
    ring.take(leg_);
    from_ = now;
    gone_ = 0;
  }

  /// A count: whatever is left of a path, each tick goes on.
  static uint32_t atLeastOne(uint32_t way) { return way == 0 ? 1 : way; }

  /// The way of the next tick at its share of the planned speed.
  uint32_t planned(const SetPoints& ring) const {
    const uint32_t left = leg_.way - gone_;
    const uint32_t asked = atLeastOne(leg_.way * share_ >> 8);
    if (asked <= left) return asked;
    if (ring.isEmpty()) return left;
    // The rest of the tick is in the next leg, at that leg's speed.
    return atLeastOne(left + (ring.first().way * shareOf(asked - left, leg_.way) >> kShareBits));
  }

  // Not inline: else every tick would save the registers that only a slower tick needs.
  __attribute__((noinline)) bool walk(SetPoints& ring, SetPoint& now) {
    if (in_step_) {
      in_step_ = false;
      gone_ = leg_.way;
      if (speed_ == 0) begin(ring, now);
    }
    if (gone_ == leg_.way && ring.isEmpty()) {
      reset();
      return takeNext(ring, now);
    }
    const uint32_t asked = is_held_ ? 0 : planned(ring);
    const uint32_t gain = leg_.gain;
    if (speed_ > asked + gain)
      speed_ -= gain;
    else if (speed_ + gain < asked)
      speed_ += gain;
    else
      speed_ = asked;
    if (speed_ == 0) return false;
    uint32_t left = leg_.way - gone_, more = speed_;
    while (more > left) {
      more -= left;
      from_ = leg_.to;
      if (!ring.take(leg_)) {
        now = from_;
        reset();
        return true;
      }
      left = leg_.way;
    }
    gone_ = leg_.way - (left - more);
    now = between();
    in_step_ = gone_ == leg_.way && !is_held_ && share_ == kAllOfIt && speed_ == leg_.way;
    return true;
  }

  SetPoint between() const {
    if (gone_ >= leg_.way) return leg_.to;
    const int32_t share = int32_t(shareOf(gone_, leg_.way));
    const SetPoint& to = leg_.to;
    return {from_.left + ((to.left - from_.left) * share >> kShareBits),
            from_.right + ((to.right - from_.right) * share >> kShareBits),
            from_.z + ((to.z - from_.z) * share >> kShareBits)};
  }

  Leg leg_ = {{0, 0, 0}, 1, 1, 0};  ///< the leg in progress
  SetPoint from_ = {0, 0, 0};       ///< where that leg began
  uint32_t gone_ = 0;               ///< [counts] of that leg
  uint32_t speed_ = 0;              ///< [counts/tick]
  uint16_t asked_ = kAllOfIt, yield_ = kAllOfIt;
  uint16_t share_ = kAllOfIt;  ///< the product of both shares
  bool is_held_ = false;
  bool in_step_ = true;  ///< it is at the last set-point taken
};

}  // namespace motion
