// How a command waits while the machine keeps working.
#pragma once

#include "course.h"
#include "planner.h"

namespace machine {

/// The waits of the main program, for commands.
///
/// Every wait of the firmware is here. During a wait, service() keeps quick characters, set-points,
/// reports and memory going, and runs the operator's lines in a hold or a pause. Each wait returns
/// false once a stop was asked for: then the command returns too.
class Waiting {
 public:
  Waiting(Clock& clock, Axes& axes, const Planner& mover, const Course& course)
      : clock_(clock), axes_(axes), planner_(mover), course_(course) {}

  /// A round of everything that goes on by itself.
  virtual void service() = 0;
  // For the operator's lines, which run during a wait.
  /// Runs a B code or `$$`.
  virtual bool runQuestion(const char* line) = 0;
  /// Answers `ok` if the line is done and not yet answered.
  virtual void answer(bool done) = 0;
  uint32_t milliseconds() { return clock_.milliseconds(); }
  bool isStopping() const { return course_.isStopping(); }
  bool isMoving() const { return !planner_.isIdle() || !axes_.isEmpty(); }

  /// A round of a wait: the processor sleeps until an interrupt, for a millisecond at most.
  void pass() {
    service();
    clock_.sleep();
  }

  /// Waits as long as condition() holds.
  template <class Condition>
  bool waitWhile(Condition condition) {
    while (!isStopping() && condition()) pass();
    return !isStopping();
  }
  /// Waits for the end of a hold or pause.
  bool untilRunning() {
    return waitWhile([&] { return course_.isWaiting(); });
  }
  bool waitFor(uint32_t ms);
  /// A wait of the program, in which the motors keep their power.
  bool dwell(uint32_t ms);
  bool isDwelling() const { return dwelling_; }
  /// Waits until the moves queued so far are done and the motors have reached their end.
  bool drain();
  /// Waits until all axes are near their set-points, up to a limit.
  void settle();
  /// Until no motor turns, also without power, and all axes that follow are near their set-points;
  /// but not for ever. Also in a stop: an encoder that was lost on the way is noticed here.
  void awaitStandstill();

 protected:
  ~Waiting() = default;

  Clock& clock_;
  Axes& axes_;
  bool dwelling_ = false;

 private:
  /// Whether all axes, or those that follow, are near their set-points.
  bool areNear(bool all) const;

  const Planner& planner_;
  const Course& course_;
};

}  // namespace machine
