// Stops, halts and alarms: what begins them, and what is done once all stands.
#include "stops.h"

namespace machine {

void Stops::halt() {
  if (!base_.waiting.untilRunning()) return;
  base_.course.take(Event::kHalt);
  forgetUnanswered();
  // Moves that were queued before are good: let them end first.
  if (base_.waiting.drain()) spindle_.turn(false);
}

void Stops::stop() {
  base_.course.take(Event::kStop);
  forgetLines();
  // Off at once, whatever else the stop has to wait for.
  base_.cutter.off();
}

/// After an alarm lines get no answer, so none waits any longer. A sender of Grbl waits for each.
void Stops::forgetUnanswered() {
  if (!base_.out.speaksGrbl()) forgetLines();
}

void Stops::forgetLines() {
  base_.input.clear();
  operator_lines_.clear();
}

void Stops::finish() {
  while (base_.waiting.isMoving()) base_.waiting.pass();
  // A motor that was let go runs on for a while.
  base_.waiting.awaitStandstill();
  // A new stop may come meanwhile: it is answered, and this stop goes on.
  const bool ends_jog = base_.course.is(State::kJogEnds);
  base_.course.take(Event::kStood);
  motors_.stayOn(false);
  if (ends_jog) {
    place_.search(Search::kStopped);
    return;
  }
  if (base_.course.isHalted()) {
    place_.search(Search::kHalted);
    spindle_.turn(false);
    return;
  }
  spindle_.turn(false);
  spindle_.switchLaser(false);
  place_.search(Search::kStopped);
  if (base_.keeper.hasLost()) base_.out.line(place_.whatIsLost());
}

void Stops::raise(Remedy remedy, FlashText text, FlashText more, FlashText last) {
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

void Stops::sayRemedy(Remedy remedy) {
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

void Stops::watchStack() {
  if (base_.clock.isStackWhole() || base_.course.is(State::kFalling) ||
      base_.course.is(State::kAlarm))
    return;
  place_.doubt(kLeftAxis, settings::Doubt::kStack);
  raise(Remedy::kSwitchOff, FLASH("The firmware's stack ran into its data"));
}

void Stops::watch() {
  watchStack();
  watchAxes();
  if (telemetry_.findsFailure())
    raise(Remedy::kOpen, telemetry_.failing(), FLASH(" complains: too hot, a short, or no 12 V"));
}

void Stops::watchAxes() {
  if (base_.wire.lost() != 0)
    raise(Remedy::kOpen, FLASH("Characters were lost on the serial line"));
  if (hung_) {
    hung_ = false;
    raise(Remedy::kOpen, FLASH("The firmware was busy for too long; motors were switched off"));
  }
  if (yield_notice_.isDue(base_.axes.hasYielded() && !axis_tests_.isTesting(),
                          base_.waiting.isMoving(), base_.clock.milliseconds()))
    base_.out.line(
        FLASH("The feed yields: a chain or z falls behind. Look for a weak supply or what holds "
              "the sled, or ask for a slower feed."));
  watchEncoders();
  const Axes::AxisFault worst = base_.axes.fault();
  // Tests make errors on purpose.
  if (axis_tests_.isTesting()) return;
  if (worst.fault != motion::Fault::kNone) raiseFault(worst);
}

void Stops::watchEncoders() {
  for (uint8_t i = 0; i < kAxisCount; ++i) {
    if (!base_.keeper.trusts(Axis(i)) || !base_.axes.hasMissedSteps(Axis(i))) continue;
    base_.keeper.doubt(Axis(i), settings::Doubt::kCounts);
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
  place_.doubtCounts();
  if (worst.fault == motion::Fault::kStands)
    return raise(Remedy::kMendAndSet, kFirst, name,
                 FLASH(" is driven and its encoder stands still"));
  raise(Remedy::kMendAndSet, kFirst, name,
        FLASH(" turns against its drive; it or its encoder is wired in reverse"));
}

void Stops::noteHang() {
  hung_ = true;
  base_.cutter.off();
}

}  // namespace machine
