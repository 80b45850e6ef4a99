// Why the machine refuses to move until Stop.
#pragma once

#include <stdint.h>

namespace machine {

/// Only Stop or a soft reset ends a lock; `~` does not.
enum class Lock : uint8_t {
  kOpen,
  kHalted,  ///< a line could not be done; the moves before it are good and are finished
  kAlarm,   ///< motors are off
};

}  // namespace machine
