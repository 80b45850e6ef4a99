// How a command waits while the machine goes on.
#pragma once

#include "axes.h"
#include "planner.h"

namespace machine {

/// The main program, as a command sees it that waits in it.
///
/// Every wait of the firmware is one of these. While it lasts, service() keeps quick characters,
/// set-points, reports and memory going, and does the operator's lines in a hold or a pause. Each
/// wait returns false once a stop was asked for: then the command unwinds.
class Waiting {
 public:
  Waiting(Clock& clock, Axes& axes, const Planner& mover)
      : clock_(clock), axes_(axes), planner_(mover) {}

  /// One round of everything that goes on by itself.
  virtual void service() = 0;
  /// Says the status if it is due and shows that the program lives; for those who write much and
  /// do not wait.
  virtual void keepReporting() = 0;

  uint32_t milliseconds() { return clock_.milliseconds(); }
  bool isStopping() const { return stopping_; }
  bool isMoving() const { return !planner_.isIdle() || !axes_.isEmpty(); }

  /// One round of a wait: the processor sleeps until something comes, for a millisecond at most.
  void pass() {
    service();
    clock_.sleep();
  }

  /// As long as condition() holds.
  template <class Condition>
  bool waitWhile(Condition condition) {
    while (!stopping_ && condition()) pass();
    return !stopping_;
  }
  bool waitFor(uint32_t ms);
  /// Until the moves queued so far are done and the motors have come to their end.
  bool drain();
  /// Until all axes are near their set-points, but not for ever.
  void settle();

 protected:
  ~Waiting() = default;

  Clock& clock_;
  Axes& axes_;
  bool stopping_ = false;  ///< a stop was asked for; every wait ends

 private:
  const Planner& planner_;
};

}  // namespace machine
