// The processor's watchdog, the last guard: it acts when the control tick itself has died. It
// interrupts first and resets only if nobody lives, because after its reset the bootloaders of
// older Megas loop until the power is taken away (with all pins open, so that no motor turns).
#pragma once

#include "machine/ports.h"

namespace board {
namespace watchdog {

/// Starts it: 60 ms without feed() and it calls `starved`, from an interrupt; another 60 ms without
/// arm(), or with interrupts held, and it resets the processor.
void begin(void (*starved)());

/// The control tick is alive.
void feed();

/// Whether it has called `starved` since arm() was last called.
bool hasBitten();

/// The main program is alive and has seen to what starved: no reset.
void arm();

/// Why the processor started this time.
machine::Start start();

}  // namespace watchdog
}  // namespace board
