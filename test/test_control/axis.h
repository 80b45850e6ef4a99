// An axis on the host: its loops, its watch, its motor, and the counts between them.
#pragma once

#include <Motion.h>

#include <algorithm>
#include <deque>
#include <vector>

#include "world/motor.h"

const double kTurnLength = 63.5;                   // [mm]
const motion::Gains kPosition = {1300, 0, 34, 1};  // the published defaults
const motion::Gains kSpeed = {5, 0, 0.28f, 1};
const unsigned kMotors = 40;

/// A set-point [mm] and the way [mm] of the set-points in a tick soon to come.
struct Asked {
  double set_point, ahead;
};

/// A motor with random tolerances by its seed, controlled at a rate [Hz].
class ControlledAxis {
 public:
  ControlledAxis(unsigned seed, double rate) : ControlledAxis(world::anyMotor(seed), seed, rate) {}

  ControlledAxis(const world::MotorConstants& constants, unsigned seed, double rate)
      : constants_(constants), motor(constants_, seed), seconds(1 / rate) {
    loop_.tune(kPosition, kSpeed, float(constants_.counts_per_turn), float(seconds));
    loop_.rest();
    watch_.tune(2, float(constants_.counts_per_turn), float(seconds));
  }

  /// A control tick; returns how far the chain is from its set-point [mm] at its end.
  double tick(const Asked& asked) {
    const double per_count = 1 / constants_.counts_per_turn;
    const int32_t counts = motor.counts();
    const double turned = (counts - counts_) * per_count;
    const int16_t moved = int16_t(counts - counts_);
    counts_ = counts;
    loop_.measure(float(turned));
    const double error = asked.set_point / kTurnLength - counts * per_count;
    duty = loop_.follow(float(error), float(asked.ahead / kTurnLength), float(turned));
    fault = watch_.look(int16_t(duty), moved, float(error * kTurnLength));
    motor.run(duty, seconds);
    return asked.set_point - motor.turns() * kTurnLength;
  }

  /// A control tick with a set-point that stays, or jumps.
  double tick(double set_point) { return tick(Asked{set_point, 0}); }

 private:
  world::MotorConstants constants_;
  motion::AxisLoop loop_;
  motion::Watch watch_;
  int32_t counts_ = 0;

 public:
  world::Motor motor;
  double seconds;
  int duty = 0;
  motion::Fault fault = motion::Fault::kNone;
};

/// A set-point that goes to and fro with bounded acceleration, and the way it will go a few ticks
/// later, as the ring of set-points gives it.
class ToAndFro {
 public:
  ToAndFro(double feed, double seconds, double from = 0)
      : top_(feed / 60),
        seconds_(seconds),
        scout_(from),
        at_(from),
        waiting_(motion::AxisLoop::ticksAhead(float(seconds)), from) {}

  /// The next set-point on the way to a goal [mm].
  Asked towards(double goal) {
    const double before = scout_;
    walk(goal);
    waiting_.push_back(scout_);
    at_ = waiting_.front();
    waiting_.pop_front();
    return {at_, scout_ - before};
  }

  double at() const { return at_; }
  bool isAt(double goal) const { return std::fabs(goal - at_) <= 1e-6; }

 private:
  void walk(double goal) {
    const double gain = 100;  // [mm/s^2]
    const double left = std::fabs(goal - scout_);
    speed_ = std::min({top_, speed_ + gain * seconds_, std::sqrt(2 * gain * left)});
    const bool arrives = left <= speed_ * seconds_;
    scout_ = arrives ? goal : scout_ + std::copysign(speed_ * seconds_, goal - scout_);
    if (arrives) speed_ = 0;
  }

  double top_, seconds_, scout_, at_, speed_ = 0;
  std::deque<double> waiting_;  ///< between the scout and the set-point
};
