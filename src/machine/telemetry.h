// B30: how the machine is doing, in a line that clients pass over; and what the board's watch says.
#pragma once

#include "board_watch.h"
#include "mover.h"
#include "printer.h"

namespace machine {

/// Looks after the board, and tells of it.
class Telemetry {
 public:
  Telemetry(Drives& drives, Aux& aux, Clock& clock, Axes& axes, Mover& mover,
            const settings::Memory& memory, const settings::Values& values, Printer& out,
            Start start)
      : drives_(drives),
        aux_(aux),
        clock_(clock),
        axes_(axes),
        mover_(mover),
        memory_(memory),
        values_(values),
        out_(out),
        start_(start) {}

  /// Looks at the board and says what has come to it; true if a motor's driver fails.
  bool findsFailure();
  /// Whose driver it was, in words.
  FlashText failure() const;
  /// B30.
  void tell();

 private:
  Drives& drives_;
  Aux& aux_;
  Clock& clock_;
  Axes& axes_;
  Mover& mover_;
  const settings::Memory& memory_;
  const settings::Values& values_;
  Printer& out_;
  BoardWatch watch_;
  uint32_t looked_ms_ = 0;
  Start start_;
};

}  // namespace machine
