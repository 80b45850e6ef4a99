// Time: milliseconds, the control tick on timer 1, and a watchdog over the main program.
#pragma once

#include "machine/ports.h"

namespace board {

/// The board's clock. The control tick runs with interrupts on, so that encoders and serial line
/// are heard meanwhile.
class ControlClock : public machine::Clock {
 public:
  /// Calls `tick` every 10 ms, or every 5 ms if `fast`; and `hang` once if idle() was not called
  /// for a second.
  void begin(void (*tick)(), void (*hang)(), bool fast);
  uint32_t milliseconds() override;
  void idle() override;
  void holdTicks() override;
  void releaseTicks() override;
};

}  // namespace board
