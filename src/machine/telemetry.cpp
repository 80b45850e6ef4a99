// Messages of the board's watch, and the line of B30.
#include "parts.h"
#include "settings_table.h"

namespace machine {

void Telemetry::noteStart() {
  if (start_ == Start::kBrownOut) parts_.memory.note(settings::Event::kBrownOut);
  if (start_ == Start::kWatchdog) parts_.memory.note(settings::Event::kWatchdog);
}

bool Telemetry::findsFailure() {
  const uint32_t now = parts_.clock.milliseconds();
  if (now - looked_ms_ < BoardWatch::kInterval) return false;
  looked_ms_ = now;
  noteSlips();
  const BoardLimits limits = {parts_.values.at(kBandGap), parts_.values.at(kLeastSupply)};
  switch (watch_.look(parts_.aux, limits, parts_.axes.isPowered(), parts_.memory.isWorn())) {
    case BoardEvent::kNone:
      break;
    case BoardEvent::kSupplyLow:
      parts_.memory.note(settings::Event::kSupplyLow);
      parts_.out << FLASH("The Mega's supply is low: ");
      parts_.out.fixed(watch_.supply(), 2).line(FLASH(" V. Check its plug and USB cable ($76)."));
      break;
    case BoardEvent::kWorn:
      parts_.out.line(FLASH("The EEPROM is worn: settings may be lost with the power. Note them."));
      break;
    case BoardEvent::kDriverFails:
      parts_.memory.note(settings::Event::kDriverFails);
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
  parts_.out << FLASH("[Telemetry|error:");
  for (uint8_t i = 0; i < kAxisCount; ++i) {
    if (i != 0) parts_.out << ',';
    parts_.out.fixed(parts_.axes.mostBehind(Axis(i)), 3);
  }
  parts_.out << FLASH("|dry:") << int32_t(parts_.planner.timesDry());
  parts_.out << FLASH("|tick:") << int32_t(parts_.clock.longestTick()) << FLASH("|illegal:");
  for (uint8_t i = 0; i < kAxisCount; ++i) {
    if (i != 0) parts_.out << ',';
    parts_.out << int32_t(parts_.drives.illegalSteps(Axis(i)));
  }
  parts_.out << FLASH("|supply:");
  parts_.out.fixed(watch_.supply(), 2) << ',';
  parts_.out.fixed(watch_.lowestSupply(), 2);
  parts_.out << (parts_.memory.isWorn()           ? FLASH("|eeprom:worn")
                 : parts_.memory.settingsStored() ? FLASH("|eeprom:ok")
                                                  : FLASH("|eeprom:writing"));
  parts_.out << FLASH("|start:");
  parts_.out << (start_ == Start::kUsual      ? FLASH("usual")
                 : start_ == Start::kBrownOut ? FLASH("brown-out")
                                              : FLASH("watchdog"));
  tellLog();
  tellSlips();
  parts_.out.line(FLASH("]"));
}

void Telemetry::tellLog() {
  using settings::Event;
  const settings::EventLog& log = parts_.memory.log();
  parts_.out << FLASH("|events:");
  for (uint8_t i = 0; i < uint8_t(Event::kCount); ++i) {
    if (i != 0) parts_.out << ',';
    parts_.out << int32_t(log.count(Event(i)));
  }
  parts_.out << FLASH("|last:") << lastEvent() << ',' << int32_t(log.total());
}

void Telemetry::noteSlips() {
  for (uint8_t i = 0; i < kZAxis; ++i) {
    const uint8_t slips = parts_.axes.slips(Axis(i));
    if (slips == slips_[i]) continue;
    slips_[i] = slips;
    slipped_ = Axis(i);
    slip_ms_ = parts_.clock.milliseconds();
    const Place at = parts_.place.now(true);
    slip_x_ = int16_t(at.x);
    slip_y_ = int16_t(at.y);
  }
}

void Telemetry::tellSlips() {
  parts_.out << FLASH("|slips:") << int32_t(slips_[kLeftAxis]) << ','
             << int32_t(slips_[kRightAxis]);
  parts_.out << FLASH("|slipped:");
  parts_.out << (slipped_ == kLeftAxis    ? FLASH("left,")
                 : slipped_ == kRightAxis ? FLASH("right,")
                                          : FLASH("none,"));
  parts_.out << int32_t(slip_x_) << ',' << int32_t(slip_y_) << ',';
  const uint32_t since = slipped_ == kAxisCount ? 0 : parts_.clock.milliseconds() - slip_ms_;
  parts_.out << int32_t(since / 1000);
}

FlashText Telemetry::lastEvent() const {
  using settings::Event;
  if (parts_.memory.log().total() == 0) return FLASH("none");
  switch (parts_.memory.log().last()) {
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
