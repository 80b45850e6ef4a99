// What the machine is doing: the table of states, events and what may move.
#pragma once

#include "axes.h"

namespace machine {

/// What the machine is doing. docs/states.md draws it.
enum class State : uint8_t {
  kRunning,   ///< lines are done, the path goes on
  kHeld,      ///< 0x84: everything stands until `~`; the operator may move z
  kPaused,    ///< M0, M1, M6 or z by hand: as above, once the path is at its end
  kResuming,  ///< `~` came; z's way back begins once its motor has power
  kLowering,  ///< z goes back to the program's height
  kStopping,  ///< `!`: everything brakes, what waits is forgotten
  kHalted,    ///< a motion was refused: queued moves end, lines are dropped
  kGivingUp,  ///< a hold in a halt: everything brakes, queued moves are forgotten
  kFalling,   ///< an alarm: no motor has power, and what still turns is braked
  kAlarm,     ///< nothing moves until a stop
  kCount,
};

/// What may change it.
enum class Event : uint8_t {
  kHold,    ///< 0x84
  kPause,   ///< a line that waits for `~` is next
  kResume,  ///< `~`
  kLower,   ///< z is about to go back
  kBack,    ///< z is where the program left it
  kStop,    ///< `!` or ctrl-X
  kHalt,    ///< a motion was refused
  kAlarm,   ///< a fault
  kStood,   ///< after a stop or a fault: nothing turns any longer
  kCount,
};

/// Whose lines are done.
enum class Lines : uint8_t { kProgram, kOperator, kNobody, kQuestions };

/// The machine's state, and the only door by which path and z stop and go on.
///
/// Motion has no other switch: the path goes in those states only whose row says so, and z leaves
/// it only while the operator's lines are done, or on its way back.
class Course {
 public:
  explicit Course(Axes& axes) : axes_(axes) {}

  State state() const { return state_; }
  bool is(State state) const { return state_ == state; }
  bool isRunning() const { return is(State::kRunning); }
  /// Whether the program waits for `~`, or for z.
  bool isWaiting() const { return state_ >= State::kHeld && state_ <= State::kLowering; }
  /// Whether z goes back, or is about to.
  bool isComingBack() const { return is(State::kResuming) || is(State::kLowering); }
  /// Whether every wait of a command ends, and everything comes to rest.
  bool isStopping() const;
  /// Whether only a stop or ctrl-X opens the machine again.
  bool isHalted() const { return state_ >= State::kHalted; }
  Lines lines() const { return linesIn(state_); }

  /// Takes an event: what may not move any longer brakes, what may goes on. False where the event
  /// changes nothing.
  bool take(Event event);

  // The table.
  /// The state after an event; kCount: it changes nothing.
  static State after(State state, Event event);
  static bool pathGoesIn(State state);
  static Lines linesIn(State state);

 private:
  Axes& axes_;
  State state_ = State::kRunning;
};

}  // namespace machine
