// The processor's watchdog is the last guard: it acts when the control tick no longer runs. It
// first interrupts, and resets only if the main program is dead too. For after a watchdog reset the
// bootloaders of older Megas loop until power is switched off. (All pins are open then, so no motor
// turns.)
#pragma once

#include "machine/ports.h"

namespace board {
namespace watchdog {

/// Starts the watchdog. After 60 ms without feed() it calls `starved` from an interrupt. After
/// another 60 ms without arm(), or with interrupts off, it resets the processor.
void begin(void (*starved)());

/// To be called by the control tick, which is alive.
void feed();

/// Whether the watchdog has called `starved` since the last arm().
bool hasBitten();

/// To be called by the main program, once it has dealt with `starved`: prevents the reset.
void arm();

/// Why the processor started this time.
machine::Start start();

}  // namespace watchdog
}  // namespace board
