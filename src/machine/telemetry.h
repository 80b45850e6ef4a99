// B30: the machine's state in a line that clients ignore; and messages of the board's watch.
#pragma once

#include "board_watch.h"
#include "sled_place.h"

namespace machine {

/// Watches the board and reports on it.
class Telemetry {
 public:
  Telemetry(Parts& parts, Start start) : parts_(parts), start_(start) {}

  /// At the start: stores why the firmware started, unless the start was usual.
  void noteStart();
  /// Looks at the board, stores and reports events; true if a motor's driver fails.
  bool findsFailure();
  /// Name of the axis whose driver failed.
  FlashText failing() const;
  /// B30.
  void tell();

 private:
  void noteSlips();
  void tellLog();
  void tellSlips();
  FlashText lastEvent() const;

  Parts& parts_;
  BoardWatch watch_;
  uint32_t looked_ms_ = 0;
  Start start_;
  uint8_t slips_[kZAxis] = {0, 0};   ///< of each chain that were noted, since the start
  Axis slipped_ = kAxisCount;        ///< the chain that may have slipped last; kAxisCount: none
  int16_t slip_x_ = 0, slip_y_ = 0;  ///< [mm] where the sled was sent then
  uint32_t slip_ms_ = 0;             ///< when that was
};

}  // namespace machine
