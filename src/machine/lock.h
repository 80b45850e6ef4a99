// Why the machine does nothing that moves until Stop.
#pragma once

#include <stdint.h>

namespace machine {

/// Only Stop or a soft reset opens it; `~` does not.
enum class Lock : uint8_t {
  kOpen,
  kHalted,  ///< a line was not done; the moves before it were good and come to their end
  kAlarm,   ///< motors are off
};

}  // namespace machine
