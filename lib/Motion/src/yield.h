// The share of the planned speed for a machine that falls behind.
#pragma once

#include "fixed.h"

namespace motion {

/// The share depends on how far the worst axis is off its set-point. Up to half the limit at which
/// the machine halts it is all of the planned speed; from nine tenths of that limit on it is the
/// least.
///
/// So a weak supply or a tight corner costs time, not the work. An axis that does not move at all
/// still reaches the limit.
class Yield {
 public:
  enum : uint16_t { kAll = 256, kLeast = 26 };

  /// `limit` [mm] is that of Watch; from 100 mm on nothing is watched and nothing yields.
  void tune(float limit) {
    const float kNoLimit = 100;
    const float most = limit < kNoLimit ? limit : kNoLimit;
    is_on_ = limit < kNoLimit;
    from_ = toCounts(0.5f * most);
    per_share_ = toCounts(0.4f * most) / (kAll - kLeast);
    if (per_share_ == 0) per_share_ = 1;
  }

  /// The share in 256ths for an axis that is off by `off` counts, which are not negative.
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
