// Lifting z during a hold, on top of its planned path.
#pragma once

#include <stdint.h>

namespace motion {

/// How far z is from its planned place while the path is held. The distance goes to a goal with
/// limited speed and acceleration, and back to zero. advance() is for the control tick.
class Lift {
 public:
  /// Sets a goal [counts], with the largest speed [counts/tick] and its largest change
  /// [counts/tick^2].
  void goTo(int32_t goal, int32_t top, int32_t gain) {
    const int32_t kMostTop = 1L << 17;
    goal_ = goal;
    top_ = top < 1 ? 1 : top > kMostTop ? kMostTop : top;
    // Braking then takes at most a thousand ticks, so the sum of their ways cannot overflow.
    const int32_t least = top_ / 1000 + 1;
    gain_ = gain < least ? least : gain;
  }
  /// Sets the distance to `at` [counts], at rest.
  void standAt(int32_t at) {
    at_ = goal_ = at;
    speed_ = 0;
  }
  /// Brakes: the goal is where z can stand at the earliest.
  void brake() {
    const int32_t size = speed_ < 0 ? -speed_ : speed_, ticks = size / gain_;
    const int32_t way = ticks * size - gain_ * (ticks * (ticks + 1) / 2);
    goal_ = at_ + (speed_ < 0 ? -way : way);
  }
  /// The place where z is becomes its planned place.
  void absorb() { standAt(0); }

  int32_t at() const { return at_; }
  int32_t goal() const { return goal_; }
  int32_t speed() const { return speed_; }  ///< [counts/tick] of the last tick
  bool isAtRest() const { return at_ == goal_ && speed_ == 0; }

  /// Takes the next tick.
  void advance() {
    if (isAtRest()) return;
    const int32_t away = goal_ - at_;
    // From here on, positive is towards the goal.
    const bool up = away > 0 || (away == 0 && speed_ < 0);
    speed_ = up ? next(away, speed_) : -next(-away, -speed_);
    at_ += speed_;
  }

 private:
  /// The fastest speed that differs from `speed` by at most the gain and still allows a stop in
  /// time.
  int32_t next(int32_t away, int32_t speed) const {
    // The rest of the way, if it is short, is a single step.
    if (speed >= 0 && away <= gain_ && speed <= 2 * gain_) return away;
    int32_t faster = speed + gain_;
    if (faster > top_) faster = top_;
    if (stopsWithin(faster, away)) return faster;
    if (speed < 0) return away;
    return stopsWithin(speed, away) ? speed : speed - gain_;
  }

  /// Whether braking from this speed, step by step, stops within `away`.
  bool stopsWithin(int32_t speed, int32_t away) const {
    if (speed <= 0) return speed <= away;
    const int32_t ticks = speed / gain_;
    return speed + ticks * speed - gain_ * (ticks * (ticks + 1) / 2) <= away;
  }

  int32_t at_ = 0, goal_ = 0, speed_ = 0;
  int32_t top_ = 1, gain_ = 1;
};

}  // namespace motion
