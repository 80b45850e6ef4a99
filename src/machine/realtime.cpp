// What happens while anything waits: characters come in, quick ones act at once, set-points go out,
// faults are noticed, reports are sent.
#include "machine.h"

namespace machine {

void Machine::service() {
  readWire();
  serveInterlude();
  if (mover_.fill(axes_, geometry_) == Moved::kOutOfReach)
    raiseAlarm(FLASH("No sled can hang on the way; the machine has halted. Press Stop."));
  watchAxes();
  watchBoard();
  refreshGeometryWhenQuiet();
  restWhenIdle();
  keepWhenAtRest();
  memory_.step();
  reportWhenDue();
  clock_.idle();
}

void Machine::serveAndSleep() {
  service();
  clock_.sleep();
}

bool Machine::waitFor(uint32_t ms) {
  const uint32_t start = clock_.milliseconds();
  while (!stopping_ && clock_.milliseconds() - start < ms) serveAndSleep();
  return !stopping_;
}

bool Machine::isFarAhead() const {
  const float ahead =
      values_.at(kMotionAhead) * 1e-3f * float(ticks_per_second_) * feed_.shareOfPlan();
  const uint8_t waiting = axes_.waiting();
  return mover_.lastsLonger(ahead > float(waiting) ? uint16_t(ahead) - waiting : 0);
}

bool Machine::drain() {
  const bool moved = isMoving();
  while (!stopping_ && isMoving()) serveAndSleep();
  if (moved) settle();
  return !stopping_;
}

void Machine::settle() {
  const float kNear = 0.012f;      // [mm]
  const uint32_t kPatience = 500;  // [ms] a motor without gains never comes nearer
  const uint32_t start = clock_.milliseconds();
  while (!stopping_ && clock_.milliseconds() - start < kPatience) {
    bool is_near = true;
    for (uint8_t i = 0; i < kAxisCount; ++i)
      is_near = is_near && float(fabs(axes_.error(Axis(i)))) < kNear;
    if (is_near) return;
    serveAndSleep();
  }
}

void Machine::readWire() {
  for (;;) {
    const int16_t character = wire_.read();
    if (character < 0) return;
    const Quick quick = input_.put(char(character));
    switch (quick) {
      case Quick::kNone:
        break;
      case Quick::kStop:
        out_.line(FLASH("ok"));
        stopNow();
        break;
      case Quick::kResume:
        out_.line(FLASH("ok"));
        resumeInterlude();
        break;
      case Quick::kHold:
        holdMotion();
        break;
      case Quick::kReset:
        resetSoftly();
        break;
      case Quick::kOverflow:
        raiseAlarm(FLASH("Buffer overflow: more lines came than there is room for. Press Stop."));
        break;
      default:
        changeFeed(quick);
        break;
    }
  }
}

void Machine::stopNow() {
  stopping_ = true;
  interlude_.end();
  lock_ = Lock::kOpen;
  input_.clear();
  // At once, whatever else the stop has to wait for.
  cutter_.off();
  mover_.stop(axes_);
}

void Machine::finishStop() {
  while (isMoving()) serveAndSleep();
  // A new stop may come meanwhile; it is answered, and this one goes on.
  stopping_ = false;
  if (isHalted()) {
    searchPlace();
    switchSpindle(false);
    return;
  }
  switchSpindle(false);
  out_.line(FLASH("Laser off"));
  if (keeper_.trustsChains())
    findPlace();
  else
    searchPlace();
  if (keeper_.hasLost()) out_.line(whatIsLost());
}

void Machine::resetSoftly() {
  stopNow();
  changeFeed(Quick::kFeedUsual);
  out_.end();
  out_.line(FLASH("soft reset commanded"));
  greet();
  sayReady();
}

void Machine::raiseAlarm(FlashText text) {
  if (lock_ == Lock::kAlarm) return;
  stopNow();
  lock_ = Lock::kAlarm;
  axes_.releaseAll();
  mover_.forget();
  axes_.standStill();
  out_ << FLASH("ALARM: ");
  out_.line(text);
}

void Machine::watchAxes() {
  if (wire_.lost() != 0) raiseAlarm(FLASH("Characters were lost on the serial line. Press Stop."));
  if (hung_) {
    hung_ = false;
    raiseAlarm(FLASH("The firmware was busy for too long; motors were switched off. Press Stop."));
  }
  sayYield();
  const motion::Fault fault = axes_.fault();
  // Tests make errors on purpose.
  if (is_testing_) return;
  if (fault == motion::Fault::kStands || fault == motion::Fault::kTurnsBack) doubtCounts();
  if (fault == motion::Fault::kLeftBehind)
    raiseAlarm(
        FLASH("The sled is not keeping up with its expected position and has halted. Press Stop, "
              "then look for what holds it."));
  if (fault == motion::Fault::kStands)
    raiseAlarm(FLASH(
        "The sled is not keeping up with its expected position: a motor is driven and its "
        "encoder stands still. Check the cables, press Stop, set the chains (B06 or B08), or z "
        "(G10 Z0)."));
  if (fault == motion::Fault::kTurnsBack)
    raiseAlarm(
        FLASH("The sled is not keeping up with its expected position: a motor turns against its "
              "drive; it or its encoder is wired in reverse. Check the cables, press Stop, set the "
              "chains (B06 or B08), or z (G10 Z0)."));
}

void Machine::sayYield() {
  const uint32_t kGap = 100, kAWhile = 1000;  // [ms] what is blocked or unplugged is named before
  const uint32_t now = clock_.milliseconds();
  const bool goes_on = now - last_yield_ms_ < kGap;
  if (!isMoving()) has_said_yield_ = false;
  if (!axes_.hasYielded() || is_testing_) return;
  if (!goes_on) yields_since_ms_ = now;
  last_yield_ms_ = now;
  if (has_said_yield_ || now - yields_since_ms_ < kAWhile || !isMoving()) return;
  has_said_yield_ = true;
  out_.line(
      FLASH("The feed yields: a chain or z falls behind. Look for a weak supply or what holds the "
            "sled, or ask for a slower feed."));
}

void Machine::noteHang() {
  hung_ = true;
  cutter_.off();
}

bool Machine::wakeMotors() {
  if (!axes_.isPowered()) {
    keeper_.beginMoving();
    while (!stopping_ && !keeper_.mayMove()) serveAndSleep();
  }
  if (!stopping_) axes_.follow();
  keeper_.endWait();
  if (stopping_) return false;
  last_motion_ms_ = clock_.milliseconds();
  return true;
}

void Machine::restWhenIdle() {
  const uint32_t now = clock_.milliseconds();
  // A test of loops stands between its jumps, and its motors hold.
  const bool is_busy = isMoving() || axes_.isDriven() || is_testing_ || interlude_.isOn();
  if (is_busy) last_motion_ms_ = now;
  if (is_busy || !axes_.isPowered()) return;
  if (now - last_motion_ms_ < uint32_t(values_.at(kIdleTime))) return;
  axes_.releaseAll();
}

}  // namespace machine
