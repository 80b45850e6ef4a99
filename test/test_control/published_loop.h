// The published firmware's control law for an axis, for comparison: it acts on the error alone.
#pragma once

#include <Motion.h>

#include <algorithm>
#include <cmath>

/// Both loops of the published firmware, with the same calls as motion::AxisLoop. Their derivatives
/// act on the measured value; duty and steps are whole numbers.
class PublishedLoop {
 public:
  static uint8_t ticksAhead(float) { return 0; }

  void tune(const motion::Gains& position, const motion::Gains& speed, float,
            float seconds_per_tick) {
    position_ = position;
    speed_ = speed;
    seconds_ = seconds_per_tick;
  }

  void rest() { rpm_ = last_rpm_ = duty_ = 0; }

  void measure(float turned) {
    last_rpm_ = rpm_;
    rpm_ = turned * 60 / seconds_;
  }

  int16_t follow(float error, float, float turned) {
    const float wanted =
        within(position_.proportional * error - position_.derivative / seconds_ * turned, 20);
    const float step = seconds_ / 0.01f * speed_.proportional * (wanted - rpm_) -
                       speed_.derivative / 0.01f * (rpm_ - last_rpm_);
    duty_ = std::trunc(within(duty_ + std::trunc(within(step, 255)), 255));
    return int16_t(duty_);
  }

 private:
  static float within(float value, float most) { return std::min(std::max(value, -most), most); }

  motion::Gains position_, speed_;
  float seconds_, rpm_, last_rpm_, duty_;
};
