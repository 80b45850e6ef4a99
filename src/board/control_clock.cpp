// Timer 1 calls the control tick; the watchdog's interrupt notices a main program that hangs.
#include "control_clock.h"

#include <Arduino.h>
#include <avr/wdt.h>

namespace board {
namespace {

void (*on_tick)();
void (*on_hang)();
uint8_t holds;
volatile bool ticking;

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
  on_tick();
  cli();
  ticking = false;
  allowTicks(true);
}

ISR(WDT_vect) { on_hang(); }

void ControlClock::begin(void (*tick)(), void (*hang)(), uint8_t ticks_per_second) {
  on_tick = tick;
  on_hang = hang;
  TIMSK1 = 0;
  TCCR1A = 0;
  TCCR1B = 1 << WGM12 | 1 << CS11 | 1 << CS10;
  OCR1A = uint16_t(kTimerPerSecond / ticks_per_second - 1);
  TCNT1 = 0;
  allowTicks(true);
  // Interrupt, not reset: bootloaders of older boards never come back from a watchdog's reset.
  cli();
  wdt_reset();
  WDTCSR = 1 << WDCE | 1 << WDE;
  WDTCSR = 1 << WDIE | 1 << WDP2 | 1 << WDP1;  // one second
  sei();
}

uint32_t ControlClock::milliseconds() { return millis(); }

void ControlClock::idle() { wdt_reset(); }

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
