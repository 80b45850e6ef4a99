// The table of states.
#include "course.h"

#include <avr/pgmspace.h>

namespace machine {
namespace {

/// The state after each event, and what each state permits.
struct Row {
  State after[uint8_t(Event::kCount)];
  bool path_goes;
  Lines lines;
};

// Short names, so that a state is a row.
const State kRun = State::kRunning, kChk = State::kChecking, kJogs = State::kJogging;
const State kEnd = State::kJogEnds, kHeld = State::kHeld, kPau = State::kPaused;
const State kRes = State::kResuming, kLow = State::kLowering, kStop = State::kStopping;
const State kHalt = State::kHalted, kGive = State::kGivingUp, kFall = State::kFalling;
const State kAlm = State::kAlarm, kNo = State::kCount;
const Lines kAll = Lines::kProgram, kRead = Lines::kChecked, kJogLines = Lines::kJogs;
const Lines kOper = Lines::kOperator, kNone = Lines::kNobody, kAsk = Lines::kQuestions;

// clang-format off
const Row kTable[uint8_t(State::kCount)] PROGMEM = {
    //             hold   pause resume lower back  stop   halt   alarm  stood  jog    endjog check  path   lines
    /* running  */{{kHeld, kPau, kNo,  kNo,  kNo,  kStop, kHalt, kFall, kNo,   kJogs, kNo,   kChk}, true,  kAll},
    /* checking */{{kNo,   kNo,  kNo,  kNo,  kNo,  kStop, kHalt, kFall, kNo,   kNo,   kNo,   kRun}, false, kRead},
    /* jogging  */{{kEnd,  kNo,  kNo,  kNo,  kNo,  kStop, kNo,   kFall, kRun,  kJogs, kEnd,  kNo},  true,  kJogLines},
    /* jog ends */{{kNo,   kNo,  kNo,  kNo,  kNo,  kStop, kNo,   kFall, kRun,  kNo,   kNo,   kNo},  false, kNone},
    /* held     */{{kHeld, kNo,  kRes, kNo,  kNo,  kStop, kNo,   kFall, kNo,   kNo,   kNo,   kNo},  false, kOper},
    /* paused   */{{kHeld, kNo,  kRes, kNo,  kNo,  kStop, kNo,   kFall, kNo,   kNo,   kNo,   kNo},  false, kOper},
    /* resuming */{{kHeld, kNo,  kNo,  kLow, kRun, kStop, kNo,   kFall, kNo,   kNo,   kNo,   kNo},  false, kNone},
    /* lowering */{{kHeld, kNo,  kNo,  kNo,  kRun, kStop, kNo,   kFall, kNo,   kNo,   kNo,   kNo},  false, kNone},
    /* stopping */{{kNo,   kNo,  kNo,  kNo,  kNo,  kStop, kNo,   kFall, kRun,  kNo,   kNo,   kNo},  false, kNone},
    /* halted   */{{kGive, kNo,  kNo,  kNo,  kNo,  kStop, kNo,   kFall, kNo,   kNo,   kNo,   kNo},  true,  kAsk},
    /* giving up*/{{kNo,   kNo,  kNo,  kNo,  kNo,  kStop, kNo,   kFall, kHalt, kNo,   kNo,   kNo},  false, kNone},
    /* falling  */{{kNo,   kNo,  kNo,  kNo,  kNo,  kStop, kNo,   kNo,   kAlm,  kNo,   kNo,   kNo},  false, kNone},
    /* alarm    */{{kNo,   kNo,  kNo,  kNo,  kNo,  kStop, kNo,   kNo,   kNo,   kNo,   kNo,   kNo},  false, kAsk},
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
  return is(State::kStopping) || is(State::kGivingUp) || is(State::kFalling) || is(State::kJogEnds);
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
