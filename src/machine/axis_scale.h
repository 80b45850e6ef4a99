// What encoder counts of an axis mean: as lengths, as turns, as counts of a set-point.
#pragma once

#include <Motion.h>
#include <math.h>

namespace machine {

/// [mm] No axis goes farther. Twice this length still fits the counts of a set-point.
const float kMostTravel = 16000;

inline float withinTravel(float length) {
  if (length > kMostTravel) return kMostTravel;
  return length < -kMostTravel ? -kMostTravel : length;
}

/// The scale of an axis. Divisions are done when it is set, so that the control tick has none.
class AxisScale {
 public:
  /// Sets how many counts a turn has, and how far [mm] the axis goes in a turn. Negative counts
  /// mean that motor or encoder is wired the other way. Returns whether a count means another
  /// length than before.
  bool set(float counts_per_turn, float mm_per_turn) {
    const float was_per_count = mm_per_count_;
    mm_per_count_ = mm_per_turn / counts_per_turn;
    turns_per_count_ = 1 / float(fabs(counts_per_turn));
    turns_per_mm_ = turns_per_count_ / mm_per_count_;
    turns_per_fine_ = turns_per_mm_ / float(motion::kCountsPerMm);
    fine_per_count_ = mm_per_count_ * float(motion::kCountsPerMm);
    is_reversed_ = counts_per_turn < 0;
    const float most = kMostTravel / float(fabs(mm_per_count_));
    most_counts_ = most < 2e9f ? int32_t(most) : 2000000000;
    return mm_per_count_ != was_per_count;
  }

  float mmPerCount() const { return mm_per_count_; }  ///< may be negative
  /// Whether a positive drive makes the count rise.
  bool isReversed() const { return is_reversed_; }

  float turnsOf(int16_t counts) const { return float(counts) * turns_per_count_; }
  float turnsOfMm(float length) const { return length * turns_per_mm_; }
  float turnsOfFine(int32_t fine) const { return float(fine) * turns_per_fine_; }

  /// [mm]
  float lengthOf(int32_t counts) const { return float(counts) * mm_per_count_; }
  /// Counts of a length [mm] within the travel.
  int32_t countsOf(float length) const {
    const float counts = length / mm_per_count_;
    if (counts >= float(most_counts_)) return most_counts_;
    return counts <= -float(most_counts_) ? -most_counts_ : int32_t(lround(counts));
  }
  /// The same length in the counts of a set-point, within the travel: counts that were stored under
  /// other settings may mean any length.
  int32_t fineOf(int32_t counts) const {
    if (counts > most_counts_) counts = most_counts_;
    if (counts < -most_counts_) counts = -most_counts_;
    return int32_t(lround(float(counts) * fine_per_count_));
  }

 private:
  int32_t most_counts_ = 0;  ///< for kMostTravel
  float mm_per_count_ = 1;
  float turns_per_count_ = 1;
  float turns_per_mm_ = 1;
  float turns_per_fine_ = 1;  ///< per count of motion::kCountsPerMm
  float fine_per_count_ = 1;  ///< counts of motion::kCountsPerMm per encoder count
  bool is_reversed_ = false;
};

}  // namespace machine
