// The table of states.
#include "course.h"

#include <avr/pgmspace.h>

namespace machine {
namespace {

/// What an event makes of a state, and what the state allows.
struct Row {
  State after[uint8_t(Event::kCount)];
  bool path_goes;
  Lines lines;
};

// Short names, so that a state is a row.
const State kRun = State::kRunning, kHeld = State::kHeld, kPau = State::kPaused;
const State kRes = State::kResuming, kLow = State::kLowering, kStop = State::kStopping;
const State kHalt = State::kHalted, kGive = State::kGivingUp, kFall = State::kFalling;
const State kAlarm = State::kAlarm, kNone = State::kCount;
const Lines kProgram = Lines::kProgram, kOperator = Lines::kOperator;
const Lines kNobody = Lines::kNobody, kQuestions = Lines::kQuestions;

// clang-format off
const Row kTable[uint8_t(State::kCount)] PROGMEM = {
    //            hold   pause  resume lower  back   stop   halt   alarm  stood    path   lines of
    /* running */ {{kHeld, kPau,  kNone, kNone, kNone, kStop, kHalt, kFall, kNone}, true,  kProgram},
    /* held */    {{kHeld, kNone, kRes,  kNone, kNone, kStop, kNone, kFall, kNone}, false, kOperator},
    /* paused */  {{kHeld, kNone, kRes,  kNone, kNone, kStop, kNone, kFall, kNone}, false, kOperator},
    /* resuming */{{kHeld, kNone, kNone, kLow,  kRun,  kStop, kNone, kFall, kNone}, false, kNobody},
    /* lowering */{{kHeld, kNone, kNone, kNone, kRun,  kStop, kNone, kFall, kNone}, false, kNobody},
    /* stopping */{{kNone, kNone, kNone, kNone, kNone, kStop, kNone, kFall, kRun},  false, kNobody},
    /* halted */  {{kGive, kNone, kNone, kNone, kNone, kStop, kNone, kFall, kNone}, true,  kQuestions},
    /* giving up*/{{kNone, kNone, kNone, kNone, kNone, kStop, kNone, kFall, kHalt}, false, kNobody},
    /* falling */ {{kNone, kNone, kNone, kNone, kNone, kStop, kNone, kNone, kAlarm},false, kNobody},
    /* alarm */   {{kNone, kNone, kNone, kNone, kNone, kStop, kNone, kNone, kNone}, false, kQuestions},
};
// clang-format on

Row rowOf(State state) {
  Row row;
  memcpy_P(&row, kTable + uint8_t(state), sizeof row);
  return row;
}

}  // namespace

State Course::after(State state, Event event) { return rowOf(state).after[uint8_t(event)]; }
bool Course::pathGoesIn(State state) { return rowOf(state).path_goes; }
Lines Course::linesIn(State state) { return rowOf(state).lines; }

bool Course::isStopping() const {
  return is(State::kStopping) || is(State::kGivingUp) || is(State::kFalling);
}

bool Course::take(Event event) {
  const State next = after(state_, event);
  if (next == State::kCount) return false;
  state_ = next;
  if (pathGoesIn(next))
    axes_.goOn();
  else
    axes_.stand();
  return true;
}

}  // namespace machine
