// Sleep of the processor.
#pragma once

#include <avr/sleep.h>

namespace board {

/// Sleeps until the next interrupt. Timers, serial line and encoders keep working and wake the
/// processor. Timer 0, which counts Arduino's milliseconds, wakes it after at most 1.024 ms.
inline void sleepUntilInterrupt() {
  set_sleep_mode(SLEEP_MODE_IDLE);
  sleep_mode();
}

}  // namespace board
