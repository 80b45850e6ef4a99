// A gear motor with its encoder as the board sees it: duty in, counts out; may stall or be cut off.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdlib>

/// An axis. A positive duty winds in, so the count falls.
class SimulatedMotor {
 public:
  /// `per_count` [mm] of travel, `top_speed` [mm/s] at full duty.
  SimulatedMotor(double per_count, double top_speed)
      : per_count_(per_count), top_speed_(top_speed) {}

  /// Lets `seconds` pass.
  void advance(double seconds) {
    const double kTimeConstant = 0.03;  // [s] inertia against the motor's back-EMF
    const int kStiction = 12;           // duty below which the gears hold
    const bool pulls = powered && !stuck && std::abs(duty) > kStiction;
    const double target = pulls ? -duty / 255.0 * top_speed_ : 0.0;
    speed_ += (target - speed_) * (1 - std::exp(-seconds / kTimeConstant));
    if (stuck) speed_ = 0;
    if (!unplugged) counted_ += speed_ * seconds;
  }

  /// The encoder, as the board's 16-bit counter shows it.
  uint16_t count() const { return uint16_t(int64_t(std::floor(counted_ / per_count_))); }

  /// After a power cut the board counts from zero again.
  void restartCount() { counted_ = 0.5 * per_count_; }

  int16_t duty = 0;
  bool powered = false, stuck = false, unplugged = false;

 private:
  double per_count_, top_speed_;
  double speed_ = 0, counted_ = 0.5 * per_count_;
};
