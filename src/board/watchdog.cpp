// The watchdog by its registers, and what a reset leaves behind.
#include "watchdog.h"

#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/wdt.h>
#include <util/atomic.h>

namespace board {
namespace {

const uint16_t kStarved = 0x5afe;

void (*on_starved)();
volatile bool bitten;

// Not cleared at the start, so the flags survive from before the reset.
uint8_t reset_flags __attribute__((section(".noinit")));
volatile uint16_t last_words __attribute__((section(".noinit")));

}  // namespace

/// Runs before main(): after a watchdog reset the watchdog stays on, and would reset again after
/// 15 ms.
void keepResetFlags() __attribute__((naked, used, section(".init3")));
void keepResetFlags() {
  reset_flags = MCUSR;
  MCUSR = 0;
  wdt_disable();
}

ISR(WDT_vect) {
  last_words = kStarved;
  bitten = true;
  on_starved();
}

void watchdog::begin(void (*starved)()) {
  on_starved = starved;
  last_words = 0;
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
    wdt_reset();
    // The second value must follow the first within four cycles.
    WDTCSR = 1 << WDCE | 1 << WDE;
    WDTCSR = 1 << WDIE | 1 << WDE | WDTO_60MS;
  }
}

void watchdog::feed() { wdt_reset(); }

bool watchdog::hasBitten() { return bitten; }

void watchdog::arm() {
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
    bitten = false;
    last_words = 0;
    WDTCSR |= 1 << WDIE;
  }
}

machine::Start watchdog::start() {
  using machine::Start;
  // Many bootloaders clear the flags. Then only what the interrupt wrote last is left.
  const bool first_power = reset_flags & 1 << PORF;
  if (reset_flags & 1 << WDRF || (!first_power && last_words == kStarved)) return Start::kWatchdog;
  return reset_flags & 1 << BORF && !first_power ? Start::kBrownOut : Start::kUsual;
}

}  // namespace board
