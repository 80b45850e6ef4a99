// What happens while anything waits: characters come in, quick characters act at once, set-points
// go out, faults are noticed, reports are sent.
#include "machine.h"

namespace machine {

void Machine::service() {
  readWire();
  operator_lines_.serve();
  if (isStopping() && axes_.isAtRest()) planner_.standHere(axes_);
  if (!planner_.fill(axes_, geometry_))
    raiseAlarm(Remedy::kOpen, FLASH("No sled can hang on the way; the machine has halted"));
  watchStack();
  watchAxes();
  if (telemetry_.findsFailure())
    raiseAlarm(Remedy::kOpen, telemetry_.failing(),
               FLASH(" complains: too hot, a short, or no 12 V"));
  new_values_.refreshWhenQuiet(isMoving());
  // In a test of loops the motors also hold between the jumps.
  motors_.restWhenIdle(isMoving() || axes_.isDriven() || axis_tests_.isTesting() ||
                       course_.isWaiting() || isDwelling());
  place_.keepWhenAtRest(clock_.milliseconds());
  memory_.step();
  keepReporting();
}

void Machine::keepReporting() {
  clock_.idle();
  if (out_.speaksGrbl()) return answerStatus();
  if (!reports_.areDue()) return;
  reports_.sayStatus(course_.isWaiting() ? FLASH("Pause")
                     : isHalted()        ? FLASH("Stop")
                                         : FLASH("Idle"),
                     placeNow());
  reports_.sayErrors();
}

/// Where the tool is. A stop drops the path before it works out where the program begins next.
Place Machine::placeNow() { return place_.now(isMoving() || isStopping()); }

bool Machine::isFarAhead() const {
  const float ahead =
      values_.at(kMotionAhead) * 1e-3f * float(ticks_per_second_) * overrides_.shareOfPlan();
  const uint8_t waiting = axes_.waiting();
  return planner_.lastsLonger(ahead > float(waiting) ? uint16_t(ahead) - waiting : 0);
}

void Machine::readWire() {
  for (;;) {
    const int16_t character = wire_.read();
    if (character < 0) return;
    gcode::Input& input = operator_lines_.inputFor(char(character));
    const gcode::Quick quick = input.put(char(character));
    if (quick == gcode::Quick::kStatus)
      askStatus(input.isInLine());
    else
      // To a sender of Grbl `!` is a hold.
      takeQuick(out_.speaksGrbl() && quick == gcode::Quick::kStop ? gcode::Quick::kHold : quick);
  }
}

void Machine::takeQuick(gcode::Quick quick) {
  using gcode::Quick;
  switch (quick) {
    case Quick::kNone:
      return;
    case Quick::kStop:
      out_.plain(FLASH("ok"));
      return stopNow();
    case Quick::kResume:
      // Whoever holds counts answers: neither 0x84 nor the ~ behind it has any.
      if (!course_.is(State::kHeld) && !out_.speaksGrbl()) out_.plain(FLASH("ok"));
      return operator_lines_.resume();
    case Quick::kHold:
      // A chain does not go on at a duty. The line gets no answer, so the client must hear why.
      if (axes_.isDriven() || axis_tests_.isTesting())
        return raiseAlarm(Remedy::kOpen, FLASH("A hold ended a pull or a test of motors"));
      // A hold ends a jog.
      return course_.is(State::kJogging) ? endJog() : operator_lines_.hold();
    case Quick::kReset:
      return out_.speaksGrbl() ? resetAsGrbl() : resetSoftly();
    case Quick::kJogCancel:
      return endJog();
    case Quick::kOverflow:
      return raiseAlarm(Remedy::kOpen,
                        FLASH("Buffer overflow: more lines came than there is room for"));
    default:
      return override(quick);
  }
}

void Machine::stopNow() {
  course_.take(Event::kStop);
  forgetLines();
  // Off at once, whatever else the stop has to wait for.
  cutter_.off();
}

/// After an alarm lines get no answer, so none waits any longer. A sender of Grbl waits for each.
void Machine::forgetUnanswered() {
  if (!out_.speaksGrbl()) forgetLines();
}

void Machine::forgetLines() {
  input_.clear();
  operator_lines_.clear();
}

void Machine::finishStop() {
  while (isMoving()) pass();
  // A motor that was let go runs on for a while.
  awaitStandstill();
  // A new stop may come meanwhile: it is answered, and this stop goes on.
  const bool ends_jog = course_.is(State::kJogEnds);
  course_.take(Event::kStood);
  motors_.stayOn(false);
  if (ends_jog) {
    place_.search(Search::kStopped);
    return;
  }
  if (isHalted()) {
    place_.search(Search::kHalted);
    spindle_.turn(false);
    return;
  }
  spindle_.turn(false);
  spindle_.switchLaser(false);
  place_.search(Search::kStopped);
  if (keeper_.hasLost()) out_.line(place_.whatIsLost());
}

void Machine::resetSoftly() {
  stopNow();
  resetOverrides();
  out_.end();
  out_.line(FLASH("soft reset commanded"));
  greeting_.sayBoard();
  greeting_.sayReady();
}

void Machine::raiseAlarm(Remedy remedy, FlashText text, FlashText more, FlashText last) {
  if (!course_.take(Event::kAlarm)) return;
  forgetUnanswered();
  cutter_.off();
  // A fault may have sped a motor up: it must not run on.
  axes_.brakeAll();
  planner_.forget();
  axes_.standStill();
  out_.alarm(grbl::kAlarmOfFault) << text << more << last << FLASH(". ");
  sayRemedy(remedy);
  out_.line(FLASH("."));
}

void Machine::sayRemedy(Remedy remedy) {
  switch (remedy) {
    case Remedy::kOpen:
      out_ << out_.toOpen();
      break;
    case Remedy::kLookForHold:
      out_ << out_.toOpen() << FLASH(", then look for what holds it");
      break;
    case Remedy::kMendAndSet:
      out_ << FLASH("Check the cables, ") << out_.alsoToOpen();
      out_ << FLASH(", set the chains (B06 or B08), or z (G10 Z0)");
      break;
    case Remedy::kSwitchOff:
      // Stop does not help: what the data hold may be wrong.
      out_ << FLASH("Switch the Mega off and on, and report the line before this one");
      break;
  }
}

void Machine::watchStack() {
  if (clock_.isStackWhole() || course_.is(State::kFalling) || course_.is(State::kAlarm)) return;
  place_.doubt(kLeftAxis, settings::Doubt::kStack);
  raiseAlarm(Remedy::kSwitchOff, FLASH("The firmware's stack ran into its data"));
}

void Machine::watchAxes() {
  if (wire_.lost() != 0)
    raiseAlarm(Remedy::kOpen, FLASH("Characters were lost on the serial line"));
  if (hung_) {
    hung_ = false;
    raiseAlarm(Remedy::kOpen,
               FLASH("The firmware was busy for too long; motors were switched off"));
  }
  if (yield_notice_.isDue(axes_.hasYielded() && !axis_tests_.isTesting(), isMoving(),
                          clock_.milliseconds()))
    out_.line(
        FLASH("The feed yields: a chain or z falls behind. Look for a weak supply or what holds "
              "the sled, or ask for a slower feed."));
  watchEncoders();
  const Axes::AxisFault worst = axes_.fault();
  // Tests make errors on purpose.
  if (axis_tests_.isTesting()) return;
  if (worst.fault != motion::Fault::kNone) raiseAlarmOf(worst);
}

void Machine::watchEncoders() {
  for (uint8_t i = 0; i < kAxisCount; ++i) {
    if (!keeper_.trusts(Axis(i)) || !axes_.hasMissedSteps(Axis(i))) continue;
    keeper_.doubt(Axis(i), settings::Doubt::kCounts);
    raiseAlarm(Remedy::kMendAndSet,
               FLASH("An encoder missed steps (B30 says which), so its counts are wrong"));
  }
}

void Machine::raiseAlarmOf(Axes::AxisFault worst) {
  const FlashText kFirst = FLASH("The sled is not keeping up with its expected position");
  const FlashText name = worst.axis == kLeftAxis    ? FLASH(": the left motor")
                         : worst.axis == kRightAxis ? FLASH(": the right motor")
                                                    : FLASH(": the z motor");
  if (worst.fault == motion::Fault::kLeftBehind)
    return raiseAlarm(Remedy::kLookForHold, kFirst, name,
                      FLASH(" is left behind, and the sled has halted"));
  // Each of these faults proves counts wrong.
  place_.doubtCounts();
  if (worst.fault == motion::Fault::kStands)
    return raiseAlarm(Remedy::kMendAndSet, kFirst, name,
                      FLASH(" is driven and its encoder stands still"));
  raiseAlarm(Remedy::kMendAndSet, kFirst, name,
             FLASH(" turns against its drive; it or its encoder is wired in reverse"));
}

void Machine::noteHang() {
  hung_ = true;
  cutter_.off();
}

void Machine::override(gcode::Quick quick) {
  // A Maslow client knows the feed's only.
  if (quick > gcode::Quick::kFeedDownOne && !out_.speaksGrbl()) return;
  if (overrides_.take(quick)) applyOverrides();
}

void Machine::resetOverrides() {
  if (overrides_.reset()) applyOverrides();
}

void Machine::applyOverrides() {
  axes_.goAt(uint16_t(overrides_.shareOfPlan() * float(motion::Playback::kAllOfIt)));
  planner_.boost(overrides_.boost(), float(overrides_.rapid()) * 0.01f);
  cutter_.override(overrides_.spindle());
  // A sender of Grbl reads them from the status.
  if (out_.speaksGrbl()) return;
  out_ << FLASH("[Feed: ") << int32_t(overrides_.feed());
  out_.line(FLASH(" %]"));
}

}  // namespace machine
