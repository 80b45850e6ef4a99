// Time: milliseconds, and the control tick on timer 1, which also watches the main program.
#pragma once

#include "machine/ports.h"

namespace board {

/// The board's clock. The control tick runs with interrupts on, so encoders and serial line are
/// served meanwhile.
class ControlClock : public machine::Clock {
 public:
  /// Calls `tick` 100 or 200 times a second. While idle() has not been called for a second, it
  /// calls `hang` in place of `tick`, and so it does once the stack has run into the data.
  void begin(void (*tick)(), void (*hang)(), uint8_t ticks_per_second);
  uint32_t milliseconds() override;
  void idle() override;
  /// Sleeps until the next millisecond.
  void sleep() override;
  void holdTicks() override;
  void releaseTicks() override;
  uint16_t longestTick() override;
  bool isStackWhole() override;
};

}  // namespace board
