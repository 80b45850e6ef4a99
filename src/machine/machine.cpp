// The machine's parts, its start after power-on, and the main program: what goes on while anything
// waits, and what is done with a line.
#include "machine.h"

namespace machine {

Machine::Machine(const Ports& ports, const BoardName& board)
    : Waiting(ports.clock, base_.axes, base_.planner, base_.course),
      base_(ports, *this),
      overrides_(base_),
      greeting_(board, base_.out),
      place_(base_),
      reports_(base_),
      telemetry_(base_, place_, board.start),
      motors_(base_, place_),
      spindle_(base_),
      z_(base_, place_),
      door_(base_, place_),
      new_values_(base_, place_),
      coordinates_(base_, place_),
      settings_lines_(base_, greeting_, place_, spindle_, new_values_, coordinates_),
      operator_lines_(base_, motors_, z_, door_, coordinates_, *this),
      pauses_(base_, operator_lines_, spindle_, place_),
      moves_(base_, motors_, coordinates_, z_, door_, pauses_),
      drilling_(base_, coordinates_, z_, moves_),
      single_axis_(base_, reports_, motors_, place_, z_, door_),
      axis_tests_(base_, motors_, place_),
      stops_(base_, place_, telemetry_, motors_, spindle_, operator_lines_, axis_tests_),
      codes_(base_, overrides_, spindle_, z_, new_values_, coordinates_, pauses_, moves_, drilling_,
             single_axis_),
      b_codes_(base_, greeting_, place_, telemetry_, motors_, z_, new_values_, single_axis_,
               axis_tests_),
      grbl_(base_, overrides_, greeting_, reports_, place_, spindle_, z_, new_values_, coordinates_,
            settings_lines_, moves_, single_axis_, stops_) {}

void Machine::begin() {
  const settings::Started started = base_.memory.start();
  base_.axes.simulate(base_.values.at(kSimulatedMotors) != 0);
  // The control tick's rate is read once: a new rate counts after a reset.
  ticks_per_second_ = base_.values.at(kLoopRate) > 150 ? 200 : 100;
  base_.axes.setTicksPerSecond(ticks_per_second_);
  new_values_.takeAll();
  base_.modal.feed = base_.values.at(kGreatestFeed) / 2;
  greeting_.sayBoard();
  greeting_.sayMotors(base_.axes.isSimulated());
  greeting_.sayStart();
  greeting_.saySource(started);
  new_values_.sayCarriedTwice();
  greeting_.sayReady();
  place_.restore(started);
  telemetry_.noteStart();
}

void Machine::service() {
  readWire();
  operator_lines_.serve();
  if (isStopping() && base_.axes.isAtRest()) base_.planner.standHere(base_.axes);
  if (!base_.planner.fill(base_.axes, base_.geometry))
    stops_.raise(Remedy::kOpen, FLASH("No sled can hang on the way; the machine has halted"));
  stops_.watch();
  new_values_.refreshWhenQuiet(isMoving());
  // In a test of loops the motors also hold between the jumps.
  motors_.restWhenIdle(isMoving() || base_.axes.isDriven() || axis_tests_.isTesting() ||
                       base_.course.isWaiting() || isDwelling());
  place_.keepWhenAtRest(base_.clock.milliseconds());
  base_.memory.step();
  keepReporting();
}

void Machine::keepReporting() {
  base_.clock.idle();
  if (base_.out.speaksGrbl()) return grbl_.answerStatus(placeNow(), is_executing_);
  if (!reports_.areDue()) return;
  reports_.sayStatus(base_.course.isWaiting()  ? FLASH("Pause")
                     : base_.course.isHalted() ? FLASH("Stop")
                                               : FLASH("Idle"),
                     placeNow());
  reports_.sayErrors();
}

/// Where the tool is. A stop drops the path before it works out where the program begins next.
Place Machine::placeNow() { return place_.now(isMoving() || isStopping()); }

bool Machine::isFarAhead() const {
  const float ahead = base_.values.at(kMotionAhead) * 1e-3f * float(ticks_per_second_) *
                      overrides_.now().shareOfPlan();
  const uint8_t waiting = base_.axes.waiting();
  return base_.planner.lastsLonger(ahead > float(waiting) ? uint16_t(ahead) - waiting : 0);
}

void Machine::readWire() {
  for (;;) {
    const int16_t character = base_.wire.read();
    if (character < 0) return;
    gcode::Input& input = operator_lines_.inputFor(char(character));
    const gcode::Quick quick = input.put(char(character));
    if (quick == gcode::Quick::kStatus)
      grbl_.askStatus(input.isInLine());
    else
      // To a sender of Grbl `!` is a hold.
      takeQuick(base_.out.speaksGrbl() && quick == gcode::Quick::kStop ? gcode::Quick::kHold
                                                                       : quick);
  }
}

void Machine::takeQuick(gcode::Quick quick) {
  using gcode::Quick;
  switch (quick) {
    case Quick::kNone:
      return;
    case Quick::kStop:
      base_.out.plain(FLASH("ok"));
      return stops_.stop();
    case Quick::kResume:
      // Whoever holds counts answers: neither 0x84 nor the ~ behind it has any.
      if (!base_.course.is(State::kHeld) && !base_.out.speaksGrbl()) base_.out.plain(FLASH("ok"));
      return operator_lines_.resume();
    case Quick::kHold:
      // A chain does not go on at a duty. The line gets no answer, so the client must hear why.
      if (base_.axes.isDriven() || axis_tests_.isTesting())
        return stops_.raise(Remedy::kOpen, FLASH("A hold ended a pull or a test of motors"));
      // A hold ends a jog.
      return base_.course.is(State::kJogging) ? grbl_.endJog() : operator_lines_.hold();
    case Quick::kReset:
      return base_.out.speaksGrbl() ? grbl_.reset() : resetSoftly();
    case Quick::kJogCancel:
      return grbl_.endJog();
    case Quick::kOverflow:
      return stops_.raise(Remedy::kOpen,
                          FLASH("Buffer overflow: more lines came than there is room for"));
    default:
      return overrides_.take(quick);
  }
}

void Machine::resetSoftly() {
  stops_.stop();
  overrides_.reset();
  base_.out.end();
  base_.out.line(FLASH("soft reset commanded"));
  greeting_.sayBoard();
  greeting_.sayReady();
}

void Machine::loop() {
  service();
  if (isStopping()) return stops_.finish();
  if (base_.course.is(State::kJogging) && !isMoving()) base_.course.take(Event::kStood);
  char line[gcode::Input::kRoom + 1];
  // A program waits here while its moves are made: nothing of a line stands on the stack.
  if (base_.course.isWaiting() || !base_.planner.hasRoom() || !base_.input.takeLine(line))
    return base_.clock.sleep();
  base_.answers.begin(line);
  if (grbl_.isDroppedJog(line)) return answer(true);
  is_executing_ = *line != '$';
  const bool done = execute(line);
  // The clients' Hold and Pause only stop sending. The queue is short enough that the sled then
  // stops soon.
  waitWhile(
      [&] { return !base_.answers.isAnswered() && (base_.course.isWaiting() || isFarAhead()); });
  is_executing_ = false;
  answer(done);
}

void Machine::answer(bool done) {
  if (base_.answers.mustHalt()) stops_.halt();
  // A line that a stop or an alarm broke off gets no answer.
  if (done && !isStopping() && !base_.answers.isAnswered()) base_.out.plain(FLASH("ok"));
}

bool Machine::execute(char* line) {
  if (base_.input.wasTooLong()) {
    if (base_.course.isHalted()) return refuseNow(kCode);
    base_.answers.begin("");
    return base_.answers.refuseWords(tooLongALine());
  }
  char* first = line;
  while (*first == ' ') ++first;
  if (grbl_.isOfMaslow(first)) grbl_.speakMaslow();
  const bool is_b = *first == 'b' || *first == 'B';
  if (is_b && mayRun(kindOf(first))) {
    // The first words of GroundControl, WebControl and the lab.
    if (bCodeOf(first) == 5) grbl_.speakMaslow();
    echo(first);
  }
  gcode::clean(line);
  if (*line == '\0') return true;
  if (!mayRun(kindOf(line))) return refuseNow(kindOf(line));
  if (is_b) return b_codes_.run(line);
  if (*line == '$') {
    const bool is_for_grbl = base_.out.speaksGrbl() || grbl_.isGreetedBy(line);
    return is_for_grbl ? grbl_.run(line) : settings_lines_.run(line);
  }
  return base_.course.is(State::kChecking) ? codes_.check(line) : codes_.run(line);
}

/// The gate of every line.
bool Machine::mayRun(Kind kind) const {
  // A jog begins, and so does the check, where nothing is on its way.
  const bool needs_rest = (kind == kJog || kind == kCheck) && base_.course.isRunning();
  return base_.course.allows(kind) && !(needs_rest && isMoving());
}

/// A line comes after an alarm: only a sender of Grbl counts on an answer.
bool Machine::refuseNow(Kind kind) {
  if (base_.course.isHalted() && !base_.out.speaksGrbl()) return false;
  const bool is_line_of_dollar = kind != kCode && kind != kAct;
  return base_.answers.refuseBare(is_line_of_dollar ? grbl::kNotIdle : grbl::kLocked);
}

void Machine::echo(const char* line) {
  uint8_t length = 0;
  for (uint8_t i = 0; line[i] != '\0'; ++i)
    if (line[i] != ' ') length = uint8_t(i + 1);
  for (uint8_t i = 0; i < length; ++i)
    base_.out << (line[i] >= 'a' && line[i] <= 'z' ? char(line[i] - 'a' + 'A') : line[i]);
  base_.out.end();
}

bool Machine::runQuestion(const char* line) {
  if (*line == 'B') return b_codes_.run(line);
  settings_lines_.dump();
  return true;
}

}  // namespace machine
