// Time: milliseconds, and the control tick on timer 1, which also watches the main program.
#pragma once

#include "machine/ports.h"

namespace board {

/// The board's clock. The control tick runs with interrupts on, so that encoders and serial line
/// are heard meanwhile.
class ControlClock : public machine::Clock {
 public:
  /// Calls `tick` 100 or 200 times a second; `hang` instead while idle() was not called for a
  /// second.
  void begin(void (*tick)(), void (*hang)(), uint8_t ticks_per_second);
  uint32_t milliseconds() override;
  void idle() override;
  /// Until the next millisecond.
  void sleep() override;
  void holdTicks() override;
  void releaseTicks() override;
  uint16_t longestTick() override;
};

}  // namespace board
