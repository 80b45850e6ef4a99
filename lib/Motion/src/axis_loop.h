// The two loops of one axis: a length asked for becomes a speed, a speed becomes a duty.
#pragma once

#include <math.h>
#include <stdint.h>

namespace motion {

/// Gains of one loop, in the published meaning: of an interval of 10 ms.
struct Gains {
  float proportional, integral, derivative;
  float weight;  ///< share of the proportional part that acts on the error; the rest on the measure
};

/// Position loop around speed loop.
///
/// Lengths are in turns, speeds in turns a minute. The position loop's output is the speed of the
/// set-point itself plus what its gains make of the error; the speed loop's output is added to the
/// duty before, so that its proportional gain acts like an integral (as in the published
/// firmware, from whose gains users start).
class AxisLoop {
 public:
  enum : int16_t { kMostDuty = 255 };

  void tune(const Gains& position, const Gains& speed, float seconds_per_tick) {
    position_ = position;
    speed_ = speed;
    // Gains are told per 10 ms.
    per_interval_ = seconds_per_tick / 0.01f;
    ticks_per_minute_ = 60 / seconds_per_tick;
    // Worked out here, as a division costs the tick 500 cycles.
    position_.integral *= seconds_per_tick;
    position_.derivative /= seconds_per_tick;
    speed_.integral *= seconds_per_tick;
    speed_.derivative /= 0.01f;
  }

  /// Begins at rest.
  void rest() { error_ = sum_ = rpm_ = last_rpm_ = duty_ = wanted_ = speed_sum_ = 0; }

  /// Takes the turns moved since the last tick; smooths over two ticks, as counts are coarse.
  void measure(float turned) {
    last_rpm_ = rpm_;
    rpm_ += (turned * ticks_per_minute_ - rpm_) * 0.5f;
  }

  /// Duty that follows a set-point which is `error` turns ahead and moved by `asked` in this tick.
  /// Positive lengthens.
  int16_t follow(float error, float asked, float turned) {
    const float change = error - error_;
    error_ = error;
    // Both are zero on most machines, and float sums are dear.
    if (position_.integral != 0) sum_ += position_.integral * error;
    if (position_.weight != 1) sum_ -= position_.proportional * (1 - position_.weight) * turned;
    sum_ = clipped(sum_, kMostRpm);
    const float ahead = position_.proportional > 0 ? asked * ticks_per_minute_ : 0;
    const float share = position_.weight == 1 ? error : position_.weight * error;
    return run(ahead + position_.proportional * share + sum_ + position_.derivative * change);
  }

  /// Duty that keeps a speed.
  int16_t run(float rpm) {
    wanted_ = clipped(rpm, kMostRpm);
    const float error = wanted_ - rpm_;
    if (speed_.integral != 0) speed_sum_ = clipped(speed_sum_ + speed_.integral * error, kMostDuty);
    float push = speed_.proportional * error + speed_sum_, hold = speed_.derivative;
    if (speed_.weight != 1) {
      push -= speed_.proportional * (1 - speed_.weight) * error;
      hold += speed_.proportional * (1 - speed_.weight);
    }
    const float step = per_interval_ * push - hold * (rpm_ - last_rpm_);
    duty_ = clipped(duty_ + clipped(step, kMostDuty), kMostDuty);
    return int16_t(duty_);
  }

  float rpm() const { return rpm_; }
  float wanted() const { return wanted_; }

 private:
  static constexpr float kMostRpm = 20;

  static float clipped(float value, float most) {
    if (value > most) return most;
    return value < -most ? -most : value;
  }

  Gains position_, speed_;
  float per_interval_, ticks_per_minute_;
  float error_, sum_, rpm_, last_rpm_, duty_, wanted_, speed_sum_;
};

}  // namespace motion
