// Timer 1 calls the control tick. The tick watches the main program, and the processor's watchdog
// watches the tick.
#include "control_clock.h"

#include <Arduino.h>

#include "sleep.h"
#include "stack_guard.h"
#include "watchdog.h"

namespace board {
namespace {

void (*on_tick)();
void (*on_hang)();
uint8_t holds;
volatile bool ticking;
uint8_t most_silent_ticks;
uint16_t longest_steps;
uint16_t timer_steps;           // of timer 1 from tick to tick
bool has_hung;                  // the main program is back from a hang; its next idle() counts
volatile uint8_t silent_ticks;  // ticks since the main program last called idle()

const uint32_t kTimerPerSecond = 250000;  // timer 1 counts at 250 kHz

void allowTicks(bool yes) {
  if (yes)
    TIMSK1 |= 1 << OCIE1A;
  else
    TIMSK1 &= uint8_t(~(1 << OCIE1A));
}

/// Keeps the compiler from moving reads and writes of shared numbers past a hold.
void fence() { __asm__ volatile("" ::: "memory"); }

void startTimer() {
  TIMSK1 = 0;
  TCCR1A = 0;
  TCCR1B = 1 << WGM12 | 1 << CS11 | 1 << CS10;
  OCR1A = uint16_t(timer_steps - 1);
  TCNT1 = 0;
}

/// Notes how long this tick took. Timer 1 restarted when this tick was due; if the next tick is due
/// already, the timer has restarted again.
void noteTime() {
  const uint16_t steps = TIFR1 & 1 << OCF1A ? UINT16_MAX / 4 : TCNT1;
  if (steps > longest_steps) longest_steps = steps;
}

/// No tick came: acts as if the main program had hung.
void letGo() {
  silent_ticks = most_silent_ticks;
  on_hang();
}

}  // namespace

ISR(TIMER1_COMPA_vect) {
  // No second tick before this tick is over, even with interrupts on.
  allowTicks(false);
  ticking = true;
  sei();
  if (silent_ticks < most_silent_ticks && stack_guard::isWhole()) {
    ++silent_ticks;
    on_tick();
  } else {
    on_hang();
  }
  cli();
  noteTime();
  watchdog::feed();
  ticking = false;
  allowTicks(true);
}

void ControlClock::begin(void (*tick)(), void (*hang)(), uint8_t ticks_per_second) {
  on_tick = tick;
  on_hang = hang;
  timer_steps = uint16_t(kTimerPerSecond / ticks_per_second);
  most_silent_ticks = ticks_per_second;
  startTimer();
  watchdog::begin(letGo);
  allowTicks(true);
}

uint32_t ControlClock::milliseconds() { return millis(); }

void ControlClock::idle() {
  // After a hang the main program runs one round before ticks may drive again.
  if (silent_ticks >= most_silent_ticks && !has_hung) {
    has_hung = true;
    return;
  }
  has_hung = false;
  silent_ticks = 0;
  if (!watchdog::hasBitten()) return;
  startTimer();
  allowTicks(true);
  watchdog::arm();
}

void ControlClock::sleep() {
  // Encoders interrupt ten thousand times a second, but their counts can wait for a control tick.
  const uint8_t now = uint8_t(millis());
  do {
    sleepUntilInterrupt();
  } while (uint8_t(millis()) == now);
}

void ControlClock::holdTicks() {
  if (ticking) return;
  allowTicks(false);
  ++holds;
  fence();
}

void ControlClock::releaseTicks() {
  // Before begin() there is nothing to call yet.
  fence();
  if (ticking || --holds != 0 || !on_tick) return;
  allowTicks(true);
}

bool ControlClock::isStackWhole() { return stack_guard::isWhole(); }

uint16_t ControlClock::longestTick() {
  holdTicks();
  const uint16_t steps = longest_steps;
  longest_steps = 0;
  releaseTicks();
  return uint16_t(steps * 4);
}

}  // namespace board
