// When motors get power, and when they lose it at rest.
#pragma once

#include "position_keeper.h"
#include "waiting.h"

namespace machine {

/// Gives the motors power, but never before the EEPROM says that the machine moves. Switches them
/// off after a rest of $9.
class MotorPower {
 public:
  MotorPower(Axes& axes, PositionKeeper& keeper, const settings::Values& values, Waiting& waiting)
      : axes_(axes), keeper_(keeper), values_(values), waiting_(waiting) {}

  bool areOn() const { return axes_.isPowered(); }
  /// Returns once all motors hold their set-points; false after a stop.
  bool wake();
  /// To be called often. `is_busy`: something moves or holds on purpose.
  void restWhenIdle(bool is_busy);
  /// Waits at most a second for the position's record.
  bool awaitRecord();

 private:
  Axes& axes_;
  PositionKeeper& keeper_;
  const settings::Values& values_;
  Waiting& waiting_;
  uint32_t last_busy_ms_ = 0;
};

}  // namespace machine
