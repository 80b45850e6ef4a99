// Messages of the board's watch, and the line of B30.
#include "telemetry.h"

#include "settings_table.h"

namespace machine {

void Telemetry::noteStart() {
  if (start_ == Start::kBrownOut) memory_.note(settings::Event::kBrownOut);
  if (start_ == Start::kWatchdog) memory_.note(settings::Event::kWatchdog);
}

bool Telemetry::findsFailure() {
  const uint32_t now = clock_.milliseconds();
  if (now - looked_ms_ < BoardWatch::kInterval) return false;
  looked_ms_ = now;
  noteSlips();
  const BoardLimits limits = {values_.at(kBandGap), values_.at(kLeastSupply)};
  switch (watch_.look(aux_, limits, axes_.isPowered(), memory_.isWorn())) {
    case BoardEvent::kNone:
      break;
    case BoardEvent::kSupplyLow:
      memory_.note(settings::Event::kSupplyLow);
      out_ << FLASH("The Mega's supply is low: ");
      out_.fixed(watch_.supply(), 2).line(FLASH(" V. Check its plug and USB cable ($76)."));
      break;
    case BoardEvent::kWorn:
      out_.line(FLASH("The EEPROM is worn: settings may be lost with the power. Note them."));
      break;
    case BoardEvent::kDriverFails:
      memory_.note(settings::Event::kDriverFails);
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
  out_ << FLASH("[Telemetry|error:");
  for (uint8_t i = 0; i < kAxisCount; ++i) {
    if (i != 0) out_ << ',';
    out_.fixed(axes_.mostBehind(Axis(i)), 3);
  }
  out_ << FLASH("|dry:") << int32_t(planner_.timesDry());
  out_ << FLASH("|tick:") << int32_t(clock_.longestTick()) << FLASH("|illegal:");
  for (uint8_t i = 0; i < kAxisCount; ++i) {
    if (i != 0) out_ << ',';
    out_ << int32_t(drives_.illegalSteps(Axis(i)));
  }
  out_ << FLASH("|supply:");
  out_.fixed(watch_.supply(), 2) << ',';
  out_.fixed(watch_.lowestSupply(), 2);
  out_ << (memory_.isWorn() ? FLASH("|eeprom:worn") : FLASH("|eeprom:ok"));
  out_ << FLASH("|start:");
  out_ << (start_ == Start::kUsual      ? FLASH("usual")
           : start_ == Start::kBrownOut ? FLASH("brown-out")
                                        : FLASH("watchdog"));
  tellLog();
  tellSlips();
  out_.line(FLASH("]"));
}

void Telemetry::tellLog() {
  using settings::Event;
  const settings::EventLog& log = memory_.log();
  out_ << FLASH("|events:");
  for (uint8_t i = 0; i < uint8_t(Event::kCount); ++i) {
    if (i != 0) out_ << ',';
    out_ << int32_t(log.count(Event(i)));
  }
  out_ << FLASH("|last:") << lastEvent() << ',' << int32_t(log.total());
}

void Telemetry::noteSlips() {
  for (uint8_t i = 0; i < kZAxis; ++i) {
    const uint8_t slips = axes_.slips(Axis(i));
    if (slips == slips_[i]) continue;
    slips_[i] = slips;
    slipped_ = Axis(i);
    slip_ms_ = clock_.milliseconds();
    const Place at = place_.now(true);
    slip_x_ = int16_t(at.x);
    slip_y_ = int16_t(at.y);
  }
}

void Telemetry::tellSlips() {
  out_ << FLASH("|slips:") << int32_t(slips_[kLeftAxis]) << ',' << int32_t(slips_[kRightAxis]);
  out_ << FLASH("|slipped:");
  out_ << (slipped_ == kLeftAxis    ? FLASH("left,")
           : slipped_ == kRightAxis ? FLASH("right,")
                                    : FLASH("none,"));
  out_ << int32_t(slip_x_) << ',' << int32_t(slip_y_) << ',';
  const uint32_t since = slipped_ == kAxisCount ? 0 : clock_.milliseconds() - slip_ms_;
  out_ << int32_t(since / 1000);
}

FlashText Telemetry::lastEvent() const {
  using settings::Event;
  if (memory_.log().total() == 0) return FLASH("none");
  switch (memory_.log().last()) {
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
