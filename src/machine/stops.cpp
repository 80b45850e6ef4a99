// Stops, halts and alarms: how they begin, and what follows once everything stands.
#include "stops.h"

namespace machine {

void Stops::halt() {
  if (!parts_.waiting.untilRunning()) return;
  parts_.course.take(Event::kHalt);
  forgetUnanswered();
  // Moves that were queued before are good: let them end first.
  if (parts_.waiting.drain()) parts_.spindle.turn(false);
}

void Stops::stop() {
  parts_.course.take(Event::kStop);
  forgetLines();
  // Off at once, whatever else the stop has to wait for.
  parts_.cutter.off();
}

/// After an alarm lines get no answer, so none waits any longer. A Grbl sender waits for each.
void Stops::forgetUnanswered() {
  if (!parts_.out.speaksGrbl()) forgetLines();
}

void Stops::forgetLines() {
  parts_.input.clear();
  parts_.operator_lines.clear();
}

void Stops::finish() {
  while (parts_.waiting.isMoving()) parts_.waiting.pass();
  // A motor that was let go runs on for a while.
  parts_.waiting.awaitStandstill();
  // A new stop may come meanwhile: it is answered, and this stop goes on.
  const bool ends_jog = parts_.course.is(State::kJogEnds);
  parts_.course.take(Event::kStood);
  parts_.motors.stayOn(false);
  if (ends_jog) {
    parts_.place.search(Search::kStopped);
    return;
  }
  if (parts_.course.isHalted()) {
    parts_.place.search(Search::kHalted);
    parts_.spindle.turn(false);
    return;
  }
  parts_.spindle.turn(false);
  parts_.spindle.switchLaser(false);
  parts_.place.search(Search::kStopped);
  if (parts_.keeper.hasLost()) parts_.out.line(parts_.place.whatIsLost());
}

void Stops::raise(Remedy remedy, FlashText text, FlashText more, FlashText last) {
  if (!parts_.course.take(Event::kAlarm)) return;
  forgetUnanswered();
  parts_.cutter.off();
  // A fault may have sped a motor up: it must not run on.
  parts_.axes.brakeAll();
  parts_.planner.forget();
  parts_.axes.standStill();
  parts_.out.alarm(grbl::kAlarmOfFault) << text << more << last << FLASH(". ");
  sayRemedy(remedy);
  parts_.out.line(FLASH("."));
}

void Stops::sayRemedy(Remedy remedy) {
  switch (remedy) {
    case Remedy::kOpen:
      parts_.out << parts_.out.toOpen();
      break;
    case Remedy::kLookForHold:
      parts_.out << parts_.out.toOpen() << FLASH(", then look for what holds it");
      break;
    case Remedy::kMendAndSet:
      parts_.out << FLASH("Check the cables, ") << parts_.out.alsoToOpen();
      parts_.out << FLASH(", set the chains (B06 or B08), or z (G10 Z0)");
      break;
    case Remedy::kSwitchOff:
      // A stop does not help: the firmware's data may be wrong.
      parts_.out << FLASH("Switch the Mega off and on, and report the line before this one");
      break;
  }
}

void Stops::watchStack() {
  if (parts_.clock.isStackWhole() || parts_.course.is(State::kFalling) ||
      parts_.course.is(State::kAlarm))
    return;
  parts_.keeper.doubt(kLeftAxis, settings::Doubt::kStack);
  raise(Remedy::kSwitchOff, FLASH("The firmware's stack ran into its data"));
}

void Stops::watch() {
  watchStack();
  watchAxes();
  if (parts_.telemetry.findsFailure())
    raise(Remedy::kOpen, parts_.telemetry.failing(),
          FLASH(" complains: too hot, a short, or no 12 V"));
}

void Stops::watchAxes() {
  if (parts_.wire.lost() != 0)
    raise(Remedy::kOpen, FLASH("Characters were lost on the serial line"));
  if (hung_) {
    hung_ = false;
    raise(Remedy::kOpen, FLASH("The firmware was busy for too long; motors were switched off"));
  }
  if (yield_notice_.isDue(parts_.axes.hasYielded() && !parts_.axis_tests.isTesting(),
                          parts_.waiting.isMoving(), parts_.clock.milliseconds()))
    parts_.out.line(
        FLASH("The feed yields: a chain or z falls behind. Look for a weak supply or what holds "
              "the sled, or ask for a slower feed."));
  watchEncoders();
  const Axes::AxisFault worst = parts_.axes.fault();
  // Tests make errors on purpose.
  if (parts_.axis_tests.isTesting()) return;
  if (worst.fault != motion::Fault::kNone) raiseFault(worst);
}

void Stops::watchEncoders() {
  for (uint8_t i = 0; i < kAxisCount; ++i) {
    if (!parts_.keeper.trusts(Axis(i)) || !parts_.axes.hasMissedSteps(Axis(i))) continue;
    parts_.keeper.doubt(Axis(i), settings::Doubt::kCounts);
    raise(Remedy::kMendAndSet,
          FLASH("An encoder missed steps (B30 says which), so its counts are wrong"));
  }
}

void Stops::raiseFault(Axes::AxisFault worst) {
  const FlashText kFirst = FLASH("The sled is not keeping up with its expected position");
  const FlashText name = worst.axis == kLeftAxis    ? FLASH(": the left motor")
                         : worst.axis == kRightAxis ? FLASH(": the right motor")
                                                    : FLASH(": the z motor");
  if (worst.fault == motion::Fault::kLeftBehind)
    return raise(Remedy::kLookForHold, kFirst, name,
                 FLASH(" is left behind, and the sled has halted"));
  // Each of these faults proves counts wrong.
  parts_.place.doubtCounts();
  if (worst.fault == motion::Fault::kStands)
    return raise(Remedy::kMendAndSet, kFirst, name,
                 FLASH(" is driven and its encoder stands still"));
  raise(Remedy::kMendAndSet, kFirst, name,
        FLASH(" turns against its drive; it or its encoder is wired in reverse"));
}

void Stops::noteHang() {
  hung_ = true;
  parts_.cutter.off();
}

}  // namespace machine
