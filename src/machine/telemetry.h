// B30: how the machine is doing, in a line that clients pass over; and what the board's watch says.
#pragma once

#include "board_watch.h"
#include "planner.h"
#include "printer.h"

namespace machine {

/// Looks after the board, and tells of it.
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

  /// At the start: keeps why it started, if that is not as usual.
  void noteStart();
  /// Looks at the board, keeps and says what has come to it; true if a motor's driver fails.
  bool findsFailure();
  /// Whose driver it was.
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
