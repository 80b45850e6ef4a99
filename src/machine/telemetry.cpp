// Messages of the board's watch, and the line of B30.
#include "telemetry.h"

#include "settings_table.h"

namespace machine {

void Telemetry::noteStart() {
  if (start_ == Start::kBrownOut) base_.memory.note(settings::Event::kBrownOut);
  if (start_ == Start::kWatchdog) base_.memory.note(settings::Event::kWatchdog);
}

bool Telemetry::findsFailure() {
  const uint32_t now = base_.clock.milliseconds();
  if (now - looked_ms_ < BoardWatch::kInterval) return false;
  looked_ms_ = now;
  noteSlips();
  const BoardLimits limits = {base_.values.at(kBandGap), base_.values.at(kLeastSupply)};
  switch (watch_.look(base_.aux, limits, base_.axes.isPowered(), base_.memory.isWorn())) {
    case BoardEvent::kNone:
      break;
    case BoardEvent::kSupplyLow:
      base_.memory.note(settings::Event::kSupplyLow);
      base_.out << FLASH("The Mega's supply is low: ");
      base_.out.fixed(watch_.supply(), 2).line(FLASH(" V. Check its plug and USB cable ($76)."));
      break;
    case BoardEvent::kWorn:
      base_.out.line(FLASH("The EEPROM is worn: settings may be lost with the power. Note them."));
      break;
    case BoardEvent::kDriverFails:
      base_.memory.note(settings::Event::kDriverFails);
      return true;
  }
  return false;
}

FlashText Telemetry::failing() const {
  const Axis axis = watch_.failing();
  if (axis == kLeftAxis) return FLASH("The left motor's driver");
  return axis == kRightAxis ? FLASH("The right motor's driver") : FLASH("The z motor's driver");
}

void Telemetry::tell() {
  base_.out << FLASH("[Telemetry|error:");
  for (uint8_t i = 0; i < kAxisCount; ++i) {
    if (i != 0) base_.out << ',';
    base_.out.fixed(base_.axes.mostBehind(Axis(i)), 3);
  }
  base_.out << FLASH("|dry:") << int32_t(base_.planner.timesDry());
  base_.out << FLASH("|tick:") << int32_t(base_.clock.longestTick()) << FLASH("|illegal:");
  for (uint8_t i = 0; i < kAxisCount; ++i) {
    if (i != 0) base_.out << ',';
    base_.out << int32_t(base_.drives.illegalSteps(Axis(i)));
  }
  base_.out << FLASH("|supply:");
  base_.out.fixed(watch_.supply(), 2) << ',';
  base_.out.fixed(watch_.lowestSupply(), 2);
  base_.out << (base_.memory.isWorn() ? FLASH("|eeprom:worn") : FLASH("|eeprom:ok"));
  base_.out << FLASH("|start:");
  base_.out << (start_ == Start::kUsual      ? FLASH("usual")
                : start_ == Start::kBrownOut ? FLASH("brown-out")
                                             : FLASH("watchdog"));
  tellLog();
  tellSlips();
  base_.out.line(FLASH("]"));
}

void Telemetry::tellLog() {
  using settings::Event;
  const settings::EventLog& log = base_.memory.log();
  base_.out << FLASH("|events:");
  for (uint8_t i = 0; i < uint8_t(Event::kCount); ++i) {
    if (i != 0) base_.out << ',';
    base_.out << int32_t(log.count(Event(i)));
  }
  base_.out << FLASH("|last:") << lastEvent() << ',' << int32_t(log.total());
}

void Telemetry::noteSlips() {
  for (uint8_t i = 0; i < kZAxis; ++i) {
    const uint8_t slips = base_.axes.slips(Axis(i));
    if (slips == slips_[i]) continue;
    slips_[i] = slips;
    slipped_ = Axis(i);
    slip_ms_ = base_.clock.milliseconds();
    const Place at = place_.now(true);
    slip_x_ = int16_t(at.x);
    slip_y_ = int16_t(at.y);
  }
}

void Telemetry::tellSlips() {
  base_.out << FLASH("|slips:") << int32_t(slips_[kLeftAxis]) << ',' << int32_t(slips_[kRightAxis]);
  base_.out << FLASH("|slipped:");
  base_.out << (slipped_ == kLeftAxis    ? FLASH("left,")
                : slipped_ == kRightAxis ? FLASH("right,")
                                         : FLASH("none,"));
  base_.out << int32_t(slip_x_) << ',' << int32_t(slip_y_) << ',';
  const uint32_t since = slipped_ == kAxisCount ? 0 : base_.clock.milliseconds() - slip_ms_;
  base_.out << int32_t(since / 1000);
}

FlashText Telemetry::lastEvent() const {
  using settings::Event;
  if (base_.memory.log().total() == 0) return FLASH("none");
  switch (base_.memory.log().last()) {
    case Event::kBrownOut:
      return FLASH("brown-out");
    case Event::kWatchdog:
      return FLASH("watchdog");
    case Event::kSupplyLow:
      return FLASH("supply");
    default:
      return FLASH("driver");
  }
}

}  // namespace machine
