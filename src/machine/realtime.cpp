// What happens while anything waits: characters come in, quick characters act at once, set-points
// go out, faults are noticed, reports are sent.
#include "machine.h"

namespace machine {

void Machine::service() {
  readWire();
  operator_lines_.serve();
  if (isStopping() && base_.axes.isAtRest()) base_.planner.standHere(base_.axes);
  if (!base_.planner.fill(base_.axes, base_.geometry))
    raiseAlarm(Remedy::kOpen, FLASH("No sled can hang on the way; the machine has halted"));
  watchStack();
  watchAxes();
  if (telemetry_.findsFailure())
    raiseAlarm(Remedy::kOpen, telemetry_.failing(),
               FLASH(" complains: too hot, a short, or no 12 V"));
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
  if (base_.out.speaksGrbl()) return answerStatus();
  if (!reports_.areDue()) return;
  reports_.sayStatus(base_.course.isWaiting() ? FLASH("Pause")
                     : isHalted()             ? FLASH("Stop")
                                              : FLASH("Idle"),
                     placeNow());
  reports_.sayErrors();
}

/// Where the tool is. A stop drops the path before it works out where the program begins next.
Place Machine::placeNow() { return place_.now(isMoving() || isStopping()); }

bool Machine::isFarAhead() const {
  const float ahead =
      base_.values.at(kMotionAhead) * 1e-3f * float(ticks_per_second_) * overrides_.shareOfPlan();
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
      askStatus(input.isInLine());
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
      return stopNow();
    case Quick::kResume:
      // Whoever holds counts answers: neither 0x84 nor the ~ behind it has any.
      if (!base_.course.is(State::kHeld) && !base_.out.speaksGrbl()) base_.out.plain(FLASH("ok"));
      return operator_lines_.resume();
    case Quick::kHold:
      // A chain does not go on at a duty. The line gets no answer, so the client must hear why.
      if (base_.axes.isDriven() || axis_tests_.isTesting())
        return raiseAlarm(Remedy::kOpen, FLASH("A hold ended a pull or a test of motors"));
      // A hold ends a jog.
      return base_.course.is(State::kJogging) ? endJog() : operator_lines_.hold();
    case Quick::kReset:
      return base_.out.speaksGrbl() ? resetAsGrbl() : resetSoftly();
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
  base_.course.take(Event::kStop);
  forgetLines();
  // Off at once, whatever else the stop has to wait for.
  base_.cutter.off();
}

/// After an alarm lines get no answer, so none waits any longer. A sender of Grbl waits for each.
void Machine::forgetUnanswered() {
  if (!base_.out.speaksGrbl()) forgetLines();
}

void Machine::forgetLines() {
  base_.input.clear();
  operator_lines_.clear();
}

void Machine::finishStop() {
  while (isMoving()) pass();
  // A motor that was let go runs on for a while.
  awaitStandstill();
  // A new stop may come meanwhile: it is answered, and this stop goes on.
  const bool ends_jog = base_.course.is(State::kJogEnds);
  base_.course.take(Event::kStood);
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
  if (base_.keeper.hasLost()) base_.out.line(place_.whatIsLost());
}

void Machine::resetSoftly() {
  stopNow();
  resetOverrides();
  base_.out.end();
  base_.out.line(FLASH("soft reset commanded"));
  greeting_.sayBoard();
  greeting_.sayReady();
}

void Machine::raiseAlarm(Remedy remedy, FlashText text, FlashText more, FlashText last) {
  if (!base_.course.take(Event::kAlarm)) return;
  forgetUnanswered();
  base_.cutter.off();
  // A fault may have sped a motor up: it must not run on.
  base_.axes.brakeAll();
  base_.planner.forget();
  base_.axes.standStill();
  base_.out.alarm(grbl::kAlarmOfFault) << text << more << last << FLASH(". ");
  sayRemedy(remedy);
  base_.out.line(FLASH("."));
}

void Machine::sayRemedy(Remedy remedy) {
  switch (remedy) {
    case Remedy::kOpen:
      base_.out << base_.out.toOpen();
      break;
    case Remedy::kLookForHold:
      base_.out << base_.out.toOpen() << FLASH(", then look for what holds it");
      break;
    case Remedy::kMendAndSet:
      base_.out << FLASH("Check the cables, ") << base_.out.alsoToOpen();
      base_.out << FLASH(", set the chains (B06 or B08), or z (G10 Z0)");
      break;
    case Remedy::kSwitchOff:
      // Stop does not help: what the data hold may be wrong.
      base_.out << FLASH("Switch the Mega off and on, and report the line before this one");
      break;
  }
}

void Machine::watchStack() {
  if (base_.clock.isStackWhole() || base_.course.is(State::kFalling) ||
      base_.course.is(State::kAlarm))
    return;
  place_.doubt(kLeftAxis, settings::Doubt::kStack);
  raiseAlarm(Remedy::kSwitchOff, FLASH("The firmware's stack ran into its data"));
}

void Machine::watchAxes() {
  if (base_.wire.lost() != 0)
    raiseAlarm(Remedy::kOpen, FLASH("Characters were lost on the serial line"));
  if (hung_) {
    hung_ = false;
    raiseAlarm(Remedy::kOpen,
               FLASH("The firmware was busy for too long; motors were switched off"));
  }
  if (yield_notice_.isDue(base_.axes.hasYielded() && !axis_tests_.isTesting(), isMoving(),
                          base_.clock.milliseconds()))
    base_.out.line(
        FLASH("The feed yields: a chain or z falls behind. Look for a weak supply or what holds "
              "the sled, or ask for a slower feed."));
  watchEncoders();
  const Axes::AxisFault worst = base_.axes.fault();
  // Tests make errors on purpose.
  if (axis_tests_.isTesting()) return;
  if (worst.fault != motion::Fault::kNone) raiseAlarmOf(worst);
}

void Machine::watchEncoders() {
  for (uint8_t i = 0; i < kAxisCount; ++i) {
    if (!base_.keeper.trusts(Axis(i)) || !base_.axes.hasMissedSteps(Axis(i))) continue;
    base_.keeper.doubt(Axis(i), settings::Doubt::kCounts);
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
  base_.cutter.off();
}

void Machine::override(gcode::Quick quick) {
  // A Maslow client knows the feed's only.
  if (quick > gcode::Quick::kFeedDownOne && !base_.out.speaksGrbl()) return;
  if (overrides_.take(quick)) applyOverrides();
}

void Machine::resetOverrides() {
  if (overrides_.reset()) applyOverrides();
}

void Machine::applyOverrides() {
  base_.axes.goAt(uint16_t(overrides_.shareOfPlan() * float(motion::Playback::kAllOfIt)));
  base_.planner.boost(overrides_.boost(), float(overrides_.rapid()) * 0.01f);
  base_.cutter.override(overrides_.spindle());
  // A sender of Grbl reads them from the status.
  if (base_.out.speaksGrbl()) return;
  base_.out << FLASH("[Feed: ") << int32_t(overrides_.feed());
  base_.out.line(FLASH(" %]"));
}

}  // namespace machine
