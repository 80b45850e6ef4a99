// When the operator is notified that the feed yields.
#pragma once

#include <stdint.h>

namespace machine {

/// Once in a motion, after the feed has yielded for a second. A blocked or unplugged motor is
/// reported earlier.
class YieldNotice {
 public:
  /// To be called often; true when the notice is due. `yields`: the feed yielded since the last
  /// call.
  bool isDue(bool yields, bool is_moving, uint32_t now_ms) {
    if (!is_moving) is_said_ = false;
    if (!yields) return false;
    if (now_ms - last_ms_ >= kGapMs) since_ms_ = now_ms;
    last_ms_ = now_ms;
    if (is_said_ || !is_moving || now_ms - since_ms_ < kPatienceMs) return false;
    is_said_ = true;
    return true;
  }

 private:
  enum : uint16_t { kGapMs = 100, kPatienceMs = 1000 };

  uint32_t since_ms_ = 0, last_ms_ = 0;
  bool is_said_ = false;  ///< said in this motion
};

}  // namespace machine
