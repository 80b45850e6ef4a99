// One number on its way to a goal with bounded speed and acceleration: the moves of single axes.
#pragma once

#include <math.h>

namespace machine {

/// A set-point that is moved tick by tick.
class Ramp {
 public:
  /// From `at` to `goal` [mm], at most `top` [mm/s], gaining and losing `gain` [mm/s^2].
  Ramp(float at, float goal, float top, float gain)
      : at_(at), goal_(goal), top_(top), gain_(gain), speed_(0) {}

  /// Moves on by so many seconds; returns where that is.
  float advance(float seconds) {
    const float left = float(fabs(goal_ - at_));
    const float may_brake = float(sqrt(2 * gain_ * left));
    float speed = speed_ + gain_ * seconds;
    if (speed > top_) speed = top_;
    if (speed > may_brake) speed = may_brake;
    speed_ = speed;
    // The last bits of a slope towards zero would never end.
    const float kNear = 0.0005f;  // [mm]
    if (left <= speed * seconds || left < kNear)
      at_ = goal_;
    else
      at_ += goal_ > at_ ? speed * seconds : -speed * seconds;
    if (isThere()) speed_ = 0;
    return at_;
  }

  /// Comes to rest as soon as the braking allows.
  void brake() {
    const float way = speed_ * speed_ / (2 * gain_);
    if (float(fabs(goal_ - at_)) > way) goal_ = goal_ > at_ ? at_ + way : at_ - way;
  }

  float at() const { return at_; }
  bool isThere() const { return at_ == goal_; }

 private:
  float at_, goal_, top_, gain_, speed_;
};

}  // namespace machine
