// Watches an axis that follows its set-points: is it left behind, does it stand still, does it turn
// against its drive?
#pragma once

#include <math.h>
#include <stdint.h>

#include "due_travel.h"

namespace motion {

/// Fault of an axis.
enum class Fault : uint8_t {
  kNone,
  kLeftBehind,  ///< it turns as it is driven, but is too far from its set-point
  kStands,      ///< driven, it counts nothing: blocked, or motor or encoder unplugged
  kTurnsBack,   ///< driven, it counts the other way: motor or encoder is wired in reverse
};

/// The watch over an axis.
///
/// Duty and counts are averaged over about four ticks. Three things are a fault:
///  - the axis is too far from its set-point: a fault at once; the averages say which;
///  - it turns against its drive for kTurnsBack;
///  - it owes too much of the travel that its duty makes due (see due_travel.h).
/// With a limit of kNoLimit or more nothing is watched: clients ask for that where motors shall
/// pull against a stop.
class Watch {
 public:
  /// `limit` [mm] is the largest allowed distance from the set-point.
  void tune(float limit, float counts_per_turn, float seconds_per_tick) {
    limit_ = limit;
    is_on_ = limit < kNoLimit;
    turns_back_most_ = uint8_t(kTurnsBack / seconds_per_tick + 0.5f);
    due_.tune(counts_per_turn, seconds_per_tick);
  }

  /// Begins at rest.
  void rest() {
    driven_ = moved_ = 0;
    turns_back_ = 0;
    due_.rest();
  }

  /// To be called each tick, with the commanded `duty`, the counts `moved` since the last tick
  /// (positive with a positive duty, if all is well), and the distance `error` [mm] from the
  /// set-point.
  Fault look(int16_t duty, int16_t moved, float error) {
    if (!is_on_) return Fault::kNone;
    const int16_t kMostMoved = 1000;  // so that a sum of four fits; no motor is that fast
    if (moved > kMostMoved) moved = kMostMoved;
    if (moved < -kMostMoved) moved = -kMostMoved;
    driven_ = int16_t(driven_ + duty - driven_ / DueTravel::kMean);
    moved_ = int16_t(moved_ + moved - moved_ / DueTravel::kMean);
    const bool is_due = due_.look(driven_, moved_, moved);
    const Fault seen = whatIsSeen();
    if (seen != Fault::kTurnsBack)
      turns_back_ = 0;
    else if (turns_back_ < turns_back_most_)
      ++turns_back_;
    if (!(float(fabs(error)) < limit_)) return seen == Fault::kNone ? Fault::kLeftBehind : seen;
    if (is_due) return goesBack() ? Fault::kTurnsBack : Fault::kStands;
    return turns_back_ >= turns_back_most_ ? Fault::kTurnsBack : Fault::kNone;
  }

 private:
  static constexpr float kNoLimit = 100;      // [mm]
  static constexpr float kTurnsBack = 0.15f;  // [s]
  enum : int16_t {
    kDriven = 128 * DueTravel::kMean,  // half the power
    kStanding = 2 * DueTravel::kMean,  // [counts] a motor at kDriven turns ten times faster
  };

  Fault whatIsSeen() const {
    if (driven_ < kDriven && driven_ > -kDriven) return Fault::kNone;
    if (moved_ < kStanding && moved_ > -kStanding) return Fault::kStands;
    return goesBack() ? Fault::kTurnsBack : Fault::kNone;
  }

  bool goesBack() const {
    const int16_t ahead = driven_ > 0 ? moved_ : int16_t(-moved_);
    return ahead <= -kStanding;
  }

  float limit_ = 2;
  bool is_on_ = true;
  int16_t driven_ = 0, moved_ = 0;  ///< averages of duty and counts, times DueTravel::kMean
  uint8_t turns_back_ = 0, turns_back_most_ = 15;
  DueTravel due_;
};

}  // namespace motion
