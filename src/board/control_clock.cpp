// Timer 1 calls the control tick. The tick is the watchdog, too: that of the processor would reset
// it, from which bootloaders of older boards never come back, or interrupt it, which this does too.
#include "control_clock.h"

#include <Arduino.h>

namespace board {
namespace {

void (*on_tick)();
void (*on_hang)();
uint8_t holds;
volatile bool ticking;
uint8_t most_silent_ticks;
volatile uint8_t silent_ticks;  // since the main program was last heard of

const uint32_t kTimerPerSecond = 250000;  // timer 1 counts at 250 kHz

void allowTicks(bool yes) {
  if (yes)
    TIMSK1 |= 1 << OCIE1A;
  else
    TIMSK1 &= uint8_t(~(1 << OCIE1A));
}

}  // namespace

ISR(TIMER1_COMPA_vect) {
  // Not again before this one is over, even with interrupts on.
  allowTicks(false);
  ticking = true;
  sei();
  if (silent_ticks < most_silent_ticks) {
    ++silent_ticks;
    on_tick();
  } else {
    on_hang();
  }
  cli();
  ticking = false;
  allowTicks(true);
}

void ControlClock::begin(void (*tick)(), void (*hang)(), uint8_t ticks_per_second) {
  on_tick = tick;
  on_hang = hang;
  TIMSK1 = 0;
  TCCR1A = 0;
  TCCR1B = 1 << WGM12 | 1 << CS11 | 1 << CS10;
  OCR1A = uint16_t(kTimerPerSecond / ticks_per_second - 1);
  TCNT1 = 0;
  most_silent_ticks = ticks_per_second;
  allowTicks(true);
}

uint32_t ControlClock::milliseconds() { return millis(); }

void ControlClock::idle() { silent_ticks = 0; }

void ControlClock::holdTicks() {
  if (ticking) return;
  allowTicks(false);
  ++holds;
}

void ControlClock::releaseTicks() {
  // Before begin() there is nothing to call yet.
  if (ticking || --holds != 0 || !on_tick) return;
  allowTicks(true);
}

}  // namespace board
