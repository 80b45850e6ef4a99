// Watches the duty of a chain's motor for a chain that lets go for a moment, as over a sprocket's
// tooth.
#pragma once

#include <stdint.h>

namespace motion {

/// A suspicion that a chain slipped, from its duty alone: no encoder sees a slip.
///
/// A chain that climbs over a tooth lets go of the sled, which falls until the chain catches it.
/// Meanwhile the motor has nothing to hold. A newton of tension is worth 0.24 steps of duty on the
/// usual motor: 10.1 mm of arm, 3.7 Nm/A, 4.15 ohm, 255 steps for 12 V. So at 95 N the duty goes
/// 23 steps towards paying out, and 30 from the tip of the tooth, for about 26 ms; with what the
/// loops add a mean over four ticks shows 8 or more. One edge that comes early or late moves the
/// duty by 15 steps in a tick and takes that back in the next: such a mean shows less than 5.
///
/// The load of a chain that is all right changes slowly. So what counts is the duty's mean over
/// four ticks less that over sixteen: its jump. It needs no number of the motor and no division.
class SlipWatch {
 public:
  /// To be called each tick with the motor's `duty`, positive to pay out.
  void measure(int16_t duty) {
    const int16_t fine = int16_t(duty * kFine);
    quick_ = int16_t(quick_ + ((fine - quick_) >> kQuick));
    slow_ = int16_t(slow_ + ((fine - slow_) >> kSlow));
  }

  /// Whether the duty jumps, to either side.
  bool isRestless() const { return jump() >= kRestless * kFine || jump() <= -kRestless * kFine; }

  /// To be called after measure(). is_even: the chain moves, no axis changes its speed, and the
  /// other chain is not restless: a motor that turns round against its friction pulls at the sled
  /// and at the supply of both. True if the chain may have slipped; then not again until all went
  /// evenly for kCalm ticks.
  bool look(bool is_even) {
    if (!is_even || jump() <= -kTugs * kFine) {
      calm_ = 0;
      return false;
    }
    if (calm_ < kCalm) {
      ++calm_;
      return false;
    }
    if (jump() < kLetsGo * kFine) return false;
    calm_ = 0;
    return true;
  }

 private:
  enum : int16_t {
    kFine = 64,     // parts of a step of duty
    kQuick = 2,     // the mean over 2^2 ticks
    kSlow = 4,      // the mean over 2^4 ticks
    kLetsGo = 7,    // [steps of duty]
    kRestless = 5,  // [steps of duty] of the other chain
    kTugs = 8,      // [steps of duty] towards winding in, of this chain
    kCalm = 48,     // [ticks]
  };

  int16_t jump() const { return int16_t(quick_ - slow_); }

  int16_t quick_ = 0, slow_ = 0;  ///< [1/kFine of a step] means of the duty
  uint8_t calm_ = 0;              ///< ticks in which all went evenly
};

/// Whether an axis keeps its speed.
class Pace {
 public:
  /// To be called each tick with the way `asked` of the axis in a tick soon to come [counts of
  /// kCountsPerMm]. True while that is near its mean over sixteen ticks.
  bool isKept(int32_t asked) {
    const int16_t way = asked > kMost ? kMost : asked < -kMost ? -kMost : int16_t(asked);
    const int16_t change = int16_t(way - mean_);
    mean_ = int16_t(mean_ + (change >> kSlow));
    return change <= kMostChange && change >= -kMostChange;
  }

  /// Whether an axis that goes this far in a tick is well away from rest, where friction turns
  /// round.
  static bool moves(int32_t asked) { return asked >= kLeast || asked <= -kLeast; }

 private:
  enum : int16_t {
    kSlow = 4,  // the mean over 2^4 ticks
    // [counts of kCountsPerMm]
    kMost = 16000,      // so that differences fit; no motor is that fast
    kMostChange = 200,  // 0.3 mm/s at 100 ticks a second; more moves the duty by 2 steps or more
    kLeast = 524,       // 0.8 mm/s
  };

  int16_t mean_ = 0;
};

}  // namespace motion
