// How much of the planned speed a machine can follow that falls behind.
#pragma once

#include "fixed.h"

namespace motion {

/// A share of the planned speed for the distance by which the worst axis is off its set-point: all
/// of it up to half the limit at which the machine halts, the least at nine tenths of it.
///
/// A weak supply or a tight corner so costs time, not the work. An axis that does not move at all
/// still comes to the limit.
class Yield {
 public:
  enum : uint16_t { kAll = 256, kLeast = 26 };

  /// `limit` [mm] as Watch has it; from 100 mm on nothing is watched and nothing yields.
  void tune(float limit) {
    const float kNoLimit = 100;
    const float most = limit < kNoLimit ? limit : kNoLimit;
    is_on_ = limit < kNoLimit;
    from_ = toCounts(0.5f * most);
    per_share_ = toCounts(0.4f * most) / (kAll - kLeast);
    if (per_share_ == 0) per_share_ = 1;
  }

  /// The share of 256 for an axis that is off by so many counts, which are not negative.
  uint16_t shareAt(int32_t off) const {
    if (off <= from_ || !is_on_) return kAll;
    const int32_t less = (off - from_) / per_share_;
    return less < kAll - kLeast ? uint16_t(kAll - less) : uint16_t(kLeast);
  }

 private:
  int32_t from_ = 0, per_share_ = 1;  ///< [counts]
  bool is_on_ = false;
};

}  // namespace motion
