// Due travel: the travel that a motor's duty should cause and that its encoder does not show.
#pragma once

#include <stdint.h>

namespace motion {

/// Sums, tick by tick, the counts that are due from the duty less those that came.
///
/// A motor turns when its duty overcomes friction, the pull of its chain and the loss in the
/// bridge.
/// The duty that this needs is learned for each direction while the motor runs evenly; it rises
/// faster than it falls. The travel that is due is what a weak motor would do with the duty beyond
/// that and a margin. So a sound motor never owes travel, even if it holds a load, breaks away late
/// or its supply sags. Counts are net: an encoder with a broken channel counts to and fro and so
/// shows none. All numbers are whole, because this runs in the control tick.
class DueTravel {
 public:
  void tune(float counts_per_turn, float seconds_per_tick) {
    const float kTurns = 0.0014f;  // [turns/s] of a weak motor, for each step of duty
    const float kUsual = 0.002f;   // [turns/s] of the usual motor
    per_duty_ = int16_t(kTurns * counts_per_turn * seconds_per_tick * kFine + 0.5f);
    const float usual = kUsual * counts_per_turn * seconds_per_tick;
    const float duty = kScale / usual;
    duty_per_count_ = int16_t(duty < kMostPerCount ? duty : float(kMostPerCount));
    most_ = int32_t(kMostTurns * counts_per_turn * kFine);
  }

  /// Begins at rest; keeps what was learned of the motor.
  void rest() { due_ = 0, back_ = 0; }

  /// To be called each tick, with the means of duty and counts over kMean ticks, times kMean, and
  /// the counts of this tick. True if too much travel is due.
  bool look(int16_t driven, int16_t moved_mean, int16_t moved) {
    const bool forward = driven >= 0;
    if (!forward)
      driven = int16_t(-driven), moved_mean = int16_t(-moved_mean), moved = int16_t(-moved);
    if (forward != forward_) rest();
    forward_ = forward;
    learn(driven / kMean, moved_mean, moved);
    const int16_t beyond = int16_t(driven / kMean - threshold());
    if (beyond > 0) due_ += int32_t(beyond) * per_duty_;
    due_ -= int32_t(paid(moved)) * (kPaid * kFine);
    if (due_ < 0) due_ = 0;
    return due_ >= most_;
  }

  enum : int16_t { kMean = 4 };  // [ticks]

 private:
  static constexpr float kMostTurns = 0.007f;  // 0.45 mm of chain
  enum : int16_t {
    kFine = 256,     // parts of a count
    kPaid = 4,       // due counts that a real count settles: a motor that moves at all is not lost
    kFro = 2,        // counts that a broken channel comes and goes
    kScale = 16,     // parts of a step of duty
    kUnknown = 120,  // duty that a stiff motor may need, before anything is learned
    kMargin = 15,    // of duty, and an eighth of the duty
    kMostNeeded = 210,  // of duty, so that full duty always makes travel due
    kSlow = 2,          // [counts a tick] below which nothing is learned
    kMostPerCount = 4000,
  };

  /// The counts that settle something. Those against the drive are no debt, as the chain of a heavy
  /// sled turns its motor so. They only take as many away from those that follow, up to kFro: else
  /// a broken channel would pay.
  int16_t paid(int16_t moved) {
    if (moved <= 0) {
      back_ = uint8_t(back_ - moved < kFro ? back_ - moved : int16_t(kFro));
      return 0;
    }
    const int16_t net = int16_t(moved - back_);
    back_ = uint8_t(net < 0 ? -net : 0);
    return net > 0 ? net : int16_t(0);
  }

  int16_t& needed() { return needed_[forward_]; }

  int16_t threshold() {
    // Never below zero: then a division is a shift.
    const uint16_t duty = uint16_t(needed()) / kScale;
    const int16_t with_margin = int16_t(duty + duty / 8 + kMargin);
    return with_margin < kMostNeeded ? with_margin : int16_t(kMostNeeded);
  }

  /// While the motor runs evenly, the duty beyond that of its speed overcomes friction and load.
  void learn(int16_t duty, int16_t moved_mean, int16_t moved) {
    const int16_t gain = int16_t(moved * kMean - moved_mean);
    if (moved_mean < kSlow * kMean || gain > kMean || gain < -kMean) return;
    const int32_t seen = duty * kScale - int32_t(moved_mean / kMean) * duty_per_count_;
    const int16_t more = int16_t((seen > 0 ? int16_t(seen) : 0) - needed());
    needed() = int16_t(needed() + (more > 0 ? more / 8 : more / 32));
  }

  int16_t per_duty_ = 0;        ///< [1/kFine counts a tick] due for each step of duty
  int16_t duty_per_count_ = 0;  ///< [1/kScale of duty] for each count a tick
  int32_t due_ = 0, most_ = 0;  ///< [1/kFine counts]
  uint8_t back_ = 0;            ///< counts against the drive that are not made good
  int16_t needed_[2] = {kUnknown * kScale, kUnknown* kScale};
  bool forward_ = true;
};

}  // namespace motion
