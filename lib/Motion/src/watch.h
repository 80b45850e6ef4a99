// Watches one axis that follows its set-points: is it left behind, does it stand, does it turn
// against its drive?
#pragma once

#include <math.h>
#include <stdint.h>

#include "due_travel.h"

namespace motion {

/// What is wrong with an axis.
enum class Fault : uint8_t {
  kNone,
  kLeftBehind,  ///< it turns the way it is driven, but is too far from its set-point
  kStands,      ///< driven, it counts nothing: blocked, or motor or encoder unplugged
  kTurnsBack,   ///< driven, it counts the other way: motor or encoder is wired in reverse
};

/// The watch over one axis.
///
/// Duty and counts are averaged over about four ticks. An axis that is too far from its set-point
/// is a fault at once, and the averages say which; one that turns back is a fault after a while,
/// one that owes the travel of its duty is a fault too, wherever it is. From a limit of kNoLimit on
/// nothing is watched: the clients ask for that where motors shall pull against a stop.
class Watch {
 public:
  /// `limit` [mm] of the distance from the set-point.
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

  /// One tick: `duty` that was asked for, counts `moved` since the last tick (positive where the
  /// duty is, if all is well), and the distance `error` [mm] from the set-point.
  Fault look(int16_t duty, int16_t moved, float error) {
    if (!is_on_) return Fault::kNone;
    const int16_t kMostMoved = 1000;  // so that sums of four fit; no motor is that fast
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
    kStanding =
        2 * DueTravel::kMean,  // [counts] a motor that is driven so hard turns ten times faster
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
  int16_t driven_ = 0, moved_ = 0;  ///< their averages, times DueTravel::kMean
  uint8_t turns_back_ = 0, turns_back_most_ = 15;
  DueTravel due_;
};

}  // namespace motion
