// Sleep of the processor.
#pragma once

#include <avr/sleep.h>

namespace board {

/// Sleeps until the next interrupt. Timers, serial line and encoders go on and wake the processor;
/// timer 0, which counts Arduino's milliseconds, does so after 1.024 ms at the latest.
inline void sleepUntilInterrupt() {
  set_sleep_mode(SLEEP_MODE_IDLE);
  sleep_mode();
}

}  // namespace board
