// State of the machine: the table of states, events and permissions to move.
#pragma once

#include "axes.h"

namespace machine {

/// State of the machine. docs/states.md draws it.
enum class State : uint8_t {
  kRunning,   ///< lines are done, the path goes on
  kChecking,  ///< `$C`: lines are read for mistakes, and nothing is done
  kJogging,   ///< `$J`: jogs are queued; the operator sends more, or ends them
  kJogEnds,   ///< a jog was broken off: everything brakes, the lines stay
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

/// Events that change it.
enum class Event : uint8_t {
  kHold,    ///< 0x84
  kPause,   ///< the next line waits for `~`
  kResume,  ///< `~`
  kLower,   ///< z is about to go back
  kBack,    ///< z is where the program left it
  kStop,    ///< `!` or ctrl-X
  kHalt,    ///< a motion was refused
  kAlarm,   ///< a fault
  kStood,   ///< after a stop, a fault or a jog: everything stands
  kJog,     ///< a jog is next
  kEndJog,  ///< 0x85
  kCheck,   ///< `$C`
  kCount,
};

/// Kinds of lines, as states accept or refuse them.
enum Kind : uint8_t {
  kQuestion = 1,  ///< says something, and changes nothing
  kSetting = 2,   ///< sets numbers
  kCode = 4,      ///< G and M codes: a line of a program
  kAct = 8,       ///< B codes that drive or declare something
  kJog = 16,      ///< `$J`
  kCheck = 32,    ///< `$C`
};

/// Which lines are run: bits of Kind. In the operator's turn OperatorLines is stricter.
enum class Lines : uint8_t {
  kNobody = 0,
  kQuestions = kQuestion | kSetting,
  kOperator = kQuestion | kAct | kCode,
  kJogs = kQuestion | kJog,
  kChecked = kQuestion | kCode | kCheck,
  kProgram = kQuestion | kSetting | kCode | kAct | kJog | kCheck,
};

/// The machine's state; path and z are stopped and started only here.
///
/// The path runs only in states whose row says so, and z leaves it only while the operator's lines
/// are done, or on its way back.
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
  /// Whether all waits of commands end and everything comes to rest.
  bool isStopping() const;
  /// Whether only a stop or ctrl-X unlocks the machine.
  bool isHalted() const { return state_ >= State::kHalted; }
  Lines lines() const { return linesIn(state_); }
  /// Whether a line of this kind, be it G, B or `$`, may run now.
  bool allows(Kind kind) const { return (uint8_t(lines()) & kind) != 0; }

  /// Takes an event: brakes what may no longer move, and starts what may. False where the event
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
