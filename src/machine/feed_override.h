// Feed override: the operator sets the feed from a tenth to twice that of the program.
#pragma once

#include <GCode.h>

namespace machine {

/// Percent of the program's feeds, as quick characters change them.
class FeedOverride {
 public:
  enum : uint8_t { kLeast = 10, kUsual = 100, kMost = 200 };

  uint8_t percent() const { return percent_; }

  /// Takes kFeedUsual to kFeedDownOne; false if nothing changes.
  bool take(gcode::Quick quick) {
    using gcode::Quick;
    const uint8_t was = percent_;
    if (quick == Quick::kFeedUsual)
      percent_ = kUsual;
    else if (quick == Quick::kFeedUp || quick == Quick::kFeedUpOne)
      raise(quick == Quick::kFeedUp ? 10 : 1);
    else if (quick == Quick::kFeedDown || quick == Quick::kFeedDownOne)
      lower(quick == Quick::kFeedDown ? 10 : 1);
    return percent_ != was;
  }

  /// Factor for the feed of each move if it is above 1; slower feeds are done by shareOfPlan().
  float boost() const { return percent_ > kUsual ? float(percent_) * 0.01f : 1; }
  /// Share [1] of the planned speed at which the axes follow the path.
  float shareOfPlan() const { return percent_ < kUsual ? float(percent_) * 0.01f : 1; }

 private:
  void raise(uint8_t by) { percent_ = percent_ + by > kMost ? uint8_t(kMost) : percent_ + by; }
  void lower(uint8_t by) { percent_ = percent_ < kLeast + by ? uint8_t(kLeast) : percent_ - by; }

  uint8_t percent_ = kUsual;
};

}  // namespace machine
