// B30: the machine's state in a line that clients ignore; and messages of the board's watch.
#pragma once

#include "board_watch.h"
#include "planner.h"
#include "printer.h"

namespace machine {

/// Watches the board and reports on it.
class Telemetry {
 public:
  Telemetry(Drives& drives, Aux& aux, Clock& clock, Axes& axes, Planner& mover,
            settings::Memory& memory, const settings::Values& values, Printer& out, Start start)
      : drives_(drives),
        aux_(aux),
        clock_(clock),
        axes_(axes),
        planner_(mover),
        memory_(memory),
        values_(values),
        out_(out),
        start_(start) {}

  /// At the start: stores why the firmware started, unless the start was usual.
  void noteStart();
  /// Looks at the board, stores and reports events; true if a motor's driver fails.
  bool findsFailure();
  /// Name of the axis whose driver failed.
  FlashText failing() const;
  /// B30.
  void tell();

 private:
  void tellLog();
  FlashText lastEvent() const;

  Drives& drives_;
  Aux& aux_;
  Clock& clock_;
  Axes& axes_;
  Planner& planner_;
  settings::Memory& memory_;
  const settings::Values& values_;
  Printer& out_;
  BoardWatch watch_;
  uint32_t looked_ms_ = 0;
  Start start_;
};

}  // namespace machine
