// A gear motor with its encoder as the board sees it: duty in, counts out; may stall or be cut off.
#pragma once

#include <cmath>
#include <cstdint>

/// An axis. A positive duty winds in, so the travel falls.
class SimulatedMotor {
 public:
  /// `per_count` [mm] of travel, `top_speed` [mm/s] at full duty.
  SimulatedMotor(double per_count, double top_speed)
      : per_count_(per_count), top_speed_(top_speed) {}

  /// Lets `seconds` pass.
  void advance(double seconds) {
    const double kTimeConstant = 0.03;  // [s] inertia against the motor's back-EMF
    const double time_constant = powered || shorted ? kTimeConstant : coasting;
    const int kStiction = 12;  // duty below which the gears hold
    const bool pulls = powered && !stuck && std::abs(duty) > kStiction;
    double target = pulls ? -duty * (reversed ? -1 : 1) / 255.0 * top_speed_ : 0.0;
    const double kSlower = 0.7;  // [1/s] a tight chain gains 25 N in a mm, which cost 0.7 mm/s
    if (target < 0 && travel < tight_at)
      target = std::fmin(0, target + kSlower * (tight_at - travel));
    speed_ += (target - speed_) * (1 - std::exp(-seconds / time_constant));
    if (stuck) speed_ = 0;
    const double moved = (speed_ + (powered ? 0 : by_hand)) * seconds;
    travel += moved;
    counted_ += unplugged ? 0 : moved;
  }

  /// How far it would still run without power [mm].
  double coast() const { return stuck ? 0 : speed_ * coasting; }

  /// The encoder, as the board's 16-bit counter shows it.
  uint16_t count() const { return uint16_t(int64_t(std::floor(counted_ / per_count_))); }

  /// The counter of a board that misses edges: the next `to_miss` pairs come at once, so their
  /// direction is unknown.
  uint16_t countMissing() {
    const uint16_t now = count();
    for (; to_miss > 0 && std::abs(int16_t(now - missed_ - seen_)) > 1; --to_miss, ++illegal)
      missed_ = uint16_t(missed_ + (int16_t(now - missed_ - seen_) > 0 ? 2 : -2));
    return seen_ = uint16_t(now - missed_);
  }

  /// After a power cut the board counts from zero again.
  void restartCount() {
    counted_ = 0.5 * per_count_;
    seen_ = missed_ = illegal = 0;
    to_miss = 0;
  }

  double travel = 0;       ///< [mm] where the axis really is
  double by_hand = 0;      ///< [mm/s] by which a hand pays out chain while the motor is off
  double coasting = 0.03;  ///< [s] time constant of a motor without power
  int16_t duty = 0;
  bool shorted = false;  ///< without power, and its winding shorted
  bool powered = false, stuck = false, unplugged = false, reversed = false;
  double tight_at = -1e9;  ///< [mm] travel below which a chain that is hooked across is tight
  bool complains = false;  ///< its driver reports an error
  int to_miss = 0;         ///< pairs of edges to come
  uint16_t illegal = 0;    ///< such pairs that came

 private:
  double per_count_, top_speed_;
  double speed_ = 0, counted_ = 0.5 * per_count_;
  uint16_t seen_ = 0, missed_ = 0;
};
