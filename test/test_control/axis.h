// One axis on the host: its loops, its watch, its motor, and the counts between.
#pragma once

#include <Motion.h>

#include <algorithm>
#include <vector>

#include "motor.h"

const double kChainPerTurn = 63.5;                 // [mm]
const motion::Gains kPosition = {1300, 0, 34, 1};  // the published defaults
const motion::Gains kSpeed = {5, 0, 0.28f, 1};
const unsigned kMotors = 40;

/// A motor as they come, by its seed, under control at a rate [Hz].
class Axis {
 public:
  Axis(unsigned seed, double rate)
      : constants_(simulated::anyMotor(seed)), motor(constants_, seed), seconds(1 / rate) {
    loop_.tune(kPosition, kSpeed, float(seconds));
    loop_.rest();
    watch_.tune(2, float(seconds));
  }

  /// One control tick with the set-point [mm]; the error [mm] before it.
  double tick(double set_point) {
    const double per_count = 1 / constants_.counts_per_turn;
    const int32_t counts = motor.counts();
    const double turned = (counts - counts_) * per_count;
    const int16_t moved = int16_t(counts - counts_);
    counts_ = counts;
    loop_.measure(float(turned));
    const double error = set_point / kChainPerTurn - counts * per_count;
    const double asked = (set_point - set_point_) / kChainPerTurn;
    set_point_ = set_point;
    duty = loop_.follow(float(error), float(asked), float(turned));
    fault = watch_.look(int16_t(duty), moved, float(error * kChainPerTurn));
    motor.run(duty, seconds);
    return set_point - motor.turns() * kChainPerTurn;
  }

 private:
  simulated::MotorConstants constants_;
  motion::AxisLoop loop_;
  motion::Watch watch_;
  int32_t counts_ = 0;
  double set_point_ = 0;

 public:
  simulated::Motor motor;
  double seconds;
  int duty = 0;
  motion::Fault fault = motion::Fault::kNone;
};

/// A set-point that goes to and fro with bounded acceleration.
class ToAndFro {
 public:
  ToAndFro(double feed, double seconds) : top_(feed / 60), seconds_(seconds) {}

  /// The next set-point on the way to a goal [mm].
  double towards(double goal) {
    const double gain = 100;  // [mm/s^2]
    const double left = std::fabs(goal - at_);
    speed_ = std::min({top_, speed_ + gain * seconds_, std::sqrt(2 * gain * left)});
    const bool arrives = left <= speed_ * seconds_;
    at_ = arrives ? goal : at_ + std::copysign(speed_ * seconds_, goal - at_);
    if (arrives) speed_ = 0;
    return at_;
  }

  bool isAt(double goal) const { return std::fabs(goal - at_) <= 1e-6; }

 private:
  double top_, seconds_, at_ = 0, speed_ = 0;
};
