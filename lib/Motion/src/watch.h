// Watches one axis that follows its set-points: is it left behind, does it stand, does it turn
// against its drive?
#pragma once

#include <math.h>
#include <stdint.h>

namespace motion {

/// What is wrong with an axis.
enum class Fault : uint8_t {
  kNone,
  kLeftBehind,  ///< it turns the way it is driven, but is too far from its set-point
  kStands,      ///< driven hard, it counts nothing: blocked, or motor or encoder unplugged
  kTurnsBack,   ///< driven hard, it counts the other way: motor or encoder is wired in reverse
};

/// The watch over one axis.
///
/// Duty and counts are averaged over about four ticks. An axis that is too far from its set-point
/// is a fault at once, and the averages say which; one that stands or turns back is a fault after a
/// while, wherever it is. From a limit of kNoLimit on nothing is watched: the clients ask for that
/// where motors shall pull against a stop.
class Watch {
 public:
  /// `limit` [mm] of the distance from the set-point.
  void tune(float limit, float seconds_per_tick) {
    limit_ = limit;
    is_on_ = limit < kNoLimit;
    stands_most_ = ticksOf(1.0f, seconds_per_tick);
    turns_back_most_ = ticksOf(0.15f, seconds_per_tick);
  }

  /// Begins at rest.
  void rest() {
    driven_ = moved_ = 0;
    stands_ = turns_back_ = 0;
  }

  /// One tick: `duty` that was asked for, counts `moved` since the last tick (positive where the
  /// duty is, if all is well), and the distance `error` [mm] from the set-point.
  Fault look(int16_t duty, int16_t moved, float error) {
    if (!is_on_) return Fault::kNone;
    const int16_t kMostMoved = 1000;  // so that sums of four fit; no motor is that fast
    if (moved > kMostMoved) moved = kMostMoved;
    if (moved < -kMostMoved) moved = -kMostMoved;
    driven_ = int16_t(driven_ + duty - driven_ / kMean);
    moved_ = int16_t(moved_ + moved - moved_ / kMean);
    const Fault seen = whatIsSeen();
    count(stands_, seen == Fault::kStands && isHard(duty));
    count(turns_back_, seen == Fault::kTurnsBack);
    if (!(float(fabs(error)) < limit_)) return seen == Fault::kNone ? Fault::kLeftBehind : seen;
    if (stands_ >= stands_most_) return Fault::kStands;
    if (turns_back_ >= turns_back_most_) return Fault::kTurnsBack;
    return Fault::kNone;
  }

 private:
  static constexpr float kNoLimit = 100;  // [mm]
  enum : int16_t {
    kMean = 4,          // [ticks]
    kDriven = 128 * 4,  // half the power
    kStanding = 2 * 4,  // [counts] a motor that is driven so hard turns ten times faster
    kHard = 250,        // all the power there is, in the published firmware's words
  };

  static uint8_t ticksOf(float seconds, float seconds_per_tick) {
    return uint8_t(seconds / seconds_per_tick + 0.5f);
  }

  static bool isHard(int16_t duty) { return duty >= kHard || duty <= -kHard; }

  static void count(uint8_t& ticks, bool is_seen) {
    if (!is_seen)
      ticks = 0;
    else if (ticks < 255)
      ++ticks;
  }

  Fault whatIsSeen() const {
    if (driven_ < kDriven && driven_ > -kDriven) return Fault::kNone;
    if (moved_ < kStanding && moved_ > -kStanding) return Fault::kStands;
    return (driven_ > 0) == (moved_ > 0) ? Fault::kNone : Fault::kTurnsBack;
  }

  float limit_ = 2;
  bool is_on_ = true;
  int16_t driven_ = 0, moved_ = 0;  ///< four times the average
  uint8_t stands_ = 0, turns_back_ = 0, stands_most_ = 100, turns_back_most_ = 15;
};

}  // namespace motion
