// The machine's parts, its start after power-on, and the main program: what goes on while anything
// waits, and what is done with a line.
#include "machine.h"

namespace machine {

Machine::Machine(const Ports& ports, const BoardName& board)
    : Waiting(ports.clock, parts_.axes, parts_.planner, parts_.course),
      parts_(ports, board, *this),
      stops_(parts_),
      codes_(parts_),
      b_codes_(parts_),
      grbl_(parts_, stops_) {}

void Machine::begin() {
  const settings::Started started = parts_.memory.start();
  parts_.axes.simulate(parts_.values.at(kSimulatedMotors) != 0);
  // The control tick's rate is read once: a new rate counts after a reset.
  ticks_per_second_ = parts_.values.at(kLoopRate) > 150 ? 200 : 100;
  parts_.axes.setTicksPerSecond(ticks_per_second_);
  parts_.new_values.takeAll();
  parts_.modal.feed = parts_.values.at(kGreatestFeed) / 2;
  parts_.greeting.sayBoard();
  parts_.greeting.sayMotors(parts_.axes.isSimulated());
  parts_.greeting.sayStart();
  parts_.greeting.saySource(started);
  parts_.new_values.sayCarriedTwice();
  parts_.greeting.sayReady();
  parts_.place.restore(started);
  parts_.telemetry.noteStart();
}

void Machine::service() {
  readWire();
  parts_.operator_lines.serve();
  if (isStopping() && parts_.axes.isAtRest()) parts_.planner.standHere(parts_.axes);
  if (!parts_.planner.fill(parts_.axes, parts_.geometry))
    stops_.raise(Remedy::kOpen, FLASH("No sled can hang on the way; the machine has halted"));
  stops_.watch();
  parts_.new_values.refreshWhenQuiet(isMoving());
  // In a test of loops the motors also hold between the jumps.
  parts_.motors.restWhenIdle(isMoving() || parts_.axes.isDriven() ||
                             parts_.axis_tests.isTesting() || parts_.course.isWaiting() ||
                             isDwelling());
  parts_.place.keepWhenAtRest(parts_.clock.milliseconds());
  parts_.memory.step();
  keepReporting();
}

void Machine::keepReporting() {
  parts_.clock.idle();
  if (parts_.out.speaksGrbl()) return grbl_.answerStatus(is_executing_);
  if (!parts_.reports.areDue()) return;
  // A stop drops the path before it works out where the program begins next.
  parts_.reports.sayStatus(parts_.course.isWaiting()  ? FLASH("Pause")
                           : parts_.course.isHalted() ? FLASH("Stop")
                                                      : FLASH("Idle"),
                           parts_.place.now(isMoving() || isStopping()));
  parts_.reports.sayErrors();
}

bool Machine::isFarAhead() const {
  const float ahead = parts_.values.at(kMotionAhead) * 1e-3f * float(ticks_per_second_) *
                      parts_.overrides.now().shareOfPlan();
  const uint8_t waiting = parts_.axes.waiting();
  return parts_.planner.lastsLonger(ahead > float(waiting) ? uint16_t(ahead) - waiting : 0);
}

void Machine::readWire() {
  for (;;) {
    const int16_t character = parts_.wire.read();
    if (character < 0) return;
    gcode::Input& input = parts_.operator_lines.inputFor(char(character));
    const gcode::Quick quick = input.put(char(character));
    if (quick == gcode::Quick::kStatus)
      grbl_.askStatus(input.isInLine());
    else
      // For a Grbl sender `!` is a hold.
      takeQuick(parts_.out.speaksGrbl() && quick == gcode::Quick::kStop ? gcode::Quick::kHold
                                                                        : quick);
  }
}

void Machine::takeQuick(gcode::Quick quick) {
  using gcode::Quick;
  switch (quick) {
    case Quick::kNone:
      return;
    case Quick::kStop:
      parts_.out.plain(FLASH("ok"));
      return stops_.stop();
    case Quick::kResume:
      // Clients that use 0x84 count answers: neither it nor the `~` after it gets one.
      if (!parts_.course.is(State::kHeld) && !parts_.out.speaksGrbl())
        parts_.out.plain(FLASH("ok"));
      return parts_.operator_lines.resume();
    case Quick::kHold:
      // A chain cannot go on at a duty. The line gets no answer, so a message says why.
      if (parts_.axes.isDriven() || parts_.axis_tests.isTesting())
        return stops_.raise(Remedy::kOpen, FLASH("A hold ended a pull or a test of motors"));
      // A hold ends a jog.
      return parts_.course.is(State::kJogging) ? grbl_.endJog() : parts_.operator_lines.hold();
    case Quick::kReset:
      return parts_.out.speaksGrbl() ? grbl_.reset() : resetSoftly();
    case Quick::kJogCancel:
      return grbl_.endJog();
    case Quick::kOverflow:
      return stops_.raise(Remedy::kOpen,
                          FLASH("Buffer overflow: more lines came than there is room for"));
    default:
      return parts_.overrides.take(quick);
  }
}

void Machine::resetSoftly() {
  stops_.stop();
  parts_.overrides.reset();
  parts_.out.end();
  parts_.out.line(FLASH("soft reset commanded"));
  parts_.greeting.sayBoard();
  parts_.greeting.sayReady();
}

void Machine::loop() {
  service();
  if (isStopping()) return stops_.finish();
  if (parts_.course.is(State::kJogging) && !isMoving()) parts_.course.take(Event::kStood);
  char line[gcode::Input::kRoom + 1];
  // A program waits here during its moves, with nothing of a line on the stack.
  if (parts_.course.isWaiting() || !parts_.planner.hasRoom() || !parts_.input.takeLine(line))
    return parts_.clock.sleep();
  parts_.answers.begin(line);
  if (grbl_.isDroppedJog(line)) return answer(true);
  is_executing_ = *line != '$';
  const bool done = execute(line);
  // The clients' Hold and Pause only stop sending. The queue is short enough that the sled then
  // stops soon.
  waitWhile(
      [&] { return !parts_.answers.isAnswered() && (parts_.course.isWaiting() || isFarAhead()); });
  is_executing_ = false;
  answer(done);
}

void Machine::answer(bool done) {
  if (parts_.answers.mustHalt()) stops_.halt();
  // A line that a stop or an alarm broke off gets no answer.
  if (done && !isStopping() && !parts_.answers.isAnswered()) parts_.out.plain(FLASH("ok"));
}

bool Machine::execute(char* line) {
  if (parts_.input.wasTooLong()) {
    if (parts_.course.isHalted()) return refuseNow(kCode);
    parts_.answers.begin("");
    return parts_.answers.refuseWords(tooLongALine());
  }
  char* first = line;
  while (*first == ' ') ++first;
  if (grbl_.isOfMaslow(first)) grbl_.speakMaslow();
  const bool is_b = *first == 'b' || *first == 'B';
  if (is_b && mayRun(kindOf(first))) {
    // The first lines that GroundControl, WebControl and the lab send.
    if (bCodeOf(first) == 5) grbl_.speakMaslow();
    echo(first);
  }
  gcode::clean(line);
  if (*line == '\0') return true;
  if (!mayRun(kindOf(line))) return refuseNow(kindOf(line));
  if (is_b) return b_codes_.run(line);
  if (*line == '$') {
    const bool is_for_grbl = parts_.out.speaksGrbl() || grbl_.isGreetedBy(line);
    return is_for_grbl ? grbl_.run(line) : parts_.settings_lines.run(line);
  }
  return parts_.course.is(State::kChecking) ? codes_.check(line) : codes_.run(line);
}

/// Decides whether a line may run.
bool Machine::mayRun(Kind kind) const {
  // A jog begins, and so does the check, where nothing is on its way.
  const bool needs_rest = (kind == kJog || kind == kCheck) && parts_.course.isRunning();
  return parts_.course.allows(kind) && !(needs_rest && isMoving());
}

/// A line after an alarm: only a Grbl sender counts on an answer.
bool Machine::refuseNow(Kind kind) {
  if (parts_.course.isHalted() && !parts_.out.speaksGrbl()) return false;
  const bool is_line_of_dollar = kind != kCode && kind != kAct;
  return parts_.answers.refuseBare(is_line_of_dollar ? grbl::kNotIdle : grbl::kLocked);
}

void Machine::echo(const char* line) {
  uint8_t length = 0;
  for (uint8_t i = 0; line[i] != '\0'; ++i)
    if (line[i] != ' ') length = uint8_t(i + 1);
  for (uint8_t i = 0; i < length; ++i)
    parts_.out << (line[i] >= 'a' && line[i] <= 'z' ? char(line[i] - 'a' + 'A') : line[i]);
  parts_.out.end();
}

bool Machine::runQuestion(const char* line) {
  if (*line == 'B') return b_codes_.run(line);
  parts_.settings_lines.dump();
  return true;
}

}  // namespace machine
