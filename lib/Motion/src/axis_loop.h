// The two loops of an axis: the position loop turns a length into a speed, the speed loop turns
// that into a duty.
#pragma once

#include <math.h>
#include <stdint.h>

namespace motion {

/// Gains of a loop, with their published meaning: for an interval of 10 ms.
struct Gains {
  float proportional, integral, derivative;
  float weight;  ///< share of the proportional part that acts on the error; the rest acts on the
                 ///< measured value
};

/// Position loop around speed loop.
///
/// Lengths are in turns, speeds in turns a minute. The position loop's output is the speed of the
/// set-points (feed forward) plus what its gains make of the error. The speed loop's output is
/// added to the last duty, so its proportional gain acts like an integral. The published firmware
/// does the same, and users start from its gains.
///
/// The feed forward is the speed of the set-points kAhead later, because a motor needs that long to
/// change its speed. The speed loop's derivative acts on the change of the measured speed less the
/// change of the feed forward.
///
/// Where the set-points turn round, the duty that drove the other way is dropped at once. The loops
/// alone would take it back by some 20 steps a tick, and friction and the bridge's loss hold the
/// motor meanwhile.
///
/// At rest an error of a count is ignored: summed up, it would turn a motor whose encoder is
/// disconnected.
class AxisLoop {
 public:
  enum : int16_t {
    kMostDuty = 255,
    kMostRpm = 20,  ///< [rpm] of the gearbox
  };

  /// [ticks] by which the feed forward looks ahead.
  static uint8_t ticksAhead(float seconds_per_tick) {
    return uint8_t(kAhead / seconds_per_tick + 0.5f);
  }

  /// Works out everything that depends on the gains alone, divisions included, so that a tick is
  /// short: a compare of floats costs 110 cycles, a product 190, a division 500.
  void tune(const Gains& position, const Gains& speed, float counts_per_turn,
            float seconds_per_tick) {
    near_ = kNear / counts_per_turn;
    position_ = position;
    speed_ = speed;
    // Gains are given for 10 ms.
    per_interval_ = seconds_per_tick / 0.01f;
    ticks_per_minute_ = 60 / seconds_per_tick;
    half_ticks_per_minute_ = ticks_per_minute_ / 2;
    push_ = per_interval_ * speed.proportional;
    position_.integral *= seconds_per_tick;
    position_.derivative /= seconds_per_tick;
    speed_.integral *= seconds_per_tick;
    speed_.derivative /= 0.01f;
    is_held_ = position.proportional > 0;
    is_summed_ = position.integral != 0 || position.weight != 1;
    is_weighted_ = position.weight != 1;
    is_speed_summed_ = speed.integral != 0;
    is_speed_weighted_ = speed.weight != 1;
    if (!is_summed_) sum_ = 0;
    if (!is_speed_summed_) speed_sum_ = 0;
  }

  /// Begins at rest.
  void rest() { error_ = sum_ = rpm_ = last_rpm_ = last_lead_ = duty_ = wanted_ = speed_sum_ = 0; }

  /// Takes the turns since the last tick. The speed is a mean over two ticks, as counts are coarse.
  void measure(float turned) {
    last_rpm_ = rpm_;
    rpm_ = turned * half_ticks_per_minute_ + rpm_ * 0.5f;
  }

  /// Duty that follows a set-point which is `error` turns ahead. `asked` is how far [turns] the
  /// set-points go in the tick that comes kAhead later. Positive lengthens the chain.
  int16_t follow(float error, float asked, float turned) {
    if (asked == 0 && error < near_ && error > -near_) error = 0;
    const float change = error - error_;
    error_ = error;
    const float ahead = is_held_ ? asked * ticks_per_minute_ : 0;
    turnRound(ahead);
    const float share = is_weighted_ ? position_.weight * error : error;
    float rpm = ahead + position_.proportional * share + position_.derivative * change;
    if (is_summed_) {
      sum_ += position_.integral * error;
      if (is_weighted_) sum_ -= position_.proportional * (1 - position_.weight) * turned;
      sum_ = clipped(sum_, kMostRpm);
      rpm += sum_;
    }
    return drive(rpm, ahead);
  }

  /// Duty that keeps a speed [rpm].
  int16_t run(float rpm) { return drive(rpm, 0); }

  float rpm() const { return rpm_; }
  float wanted() const { return wanted_; }

 private:
  static constexpr float kAhead = 0.03f;  // [s]
  static constexpr float kNear = 1.5f;    // [counts]
  static constexpr float kSlow = 0.25f;   // [rpm] slower set-points have no clear direction

  /// Drops a duty against the direction of the set-points, once each time that they turn round.
  void turnRound(float ahead) {
    const bool lengthens = ahead > 0;
    if (lengthens == lengthens_ || !(float(fabs(ahead)) > kSlow)) return;
    lengthens_ = lengthens;
    if ((duty_ > 0) != lengthens) duty_ = 0;
  }

  int16_t drive(float rpm, float ahead) {
    wanted_ = clipped(rpm, kMostRpm);
    const float error = wanted_ - rpm_;
    const float lead = rpm_ - ahead;
    float step = push_ * error - speed_.derivative * (lead - last_lead_);
    last_lead_ = lead;
    if (is_speed_summed_) {
      speed_sum_ = clipped(speed_sum_ + speed_.integral * error, kMostDuty);
      step += per_interval_ * speed_sum_;
    }
    if (is_speed_weighted_) {
      const float on_measure = speed_.proportional * (1 - speed_.weight);
      step -= on_measure * (per_interval_ * error + rpm_ - last_rpm_);
    }
    duty_ = clipped(duty_ + clipped(step, kMostDuty), kMostDuty);
    return int16_t(duty_);
  }

  static float clipped(float value, float most) {
    // A single compare settles nearly all values.
    if (!(float(fabs(value)) > most)) return value;
    return value > 0 ? most : -most;
  }

  Gains position_, speed_;
  float per_interval_, ticks_per_minute_, half_ticks_per_minute_, push_, near_;
  bool is_held_, is_summed_, is_weighted_, is_speed_summed_, is_speed_weighted_;
  bool lengthens_ = true;  ///< the direction of the set-points
  float error_, sum_, rpm_, last_rpm_, last_lead_, duty_, wanted_, speed_sum_;
};

}  // namespace motion
