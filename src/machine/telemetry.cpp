// The board's watch in words, and the line of B30.
#include "telemetry.h"

#include "settings_table.h"

namespace machine {

bool Telemetry::findsFailure() {
  const uint32_t now = clock_.milliseconds();
  if (now - looked_ms_ < BoardWatch::kInterval) return false;
  looked_ms_ = now;
  const BoardLimits limits = {values_.at(kBandGap), values_.at(kLeastSupply)};
  switch (watch_.look(aux_, limits, axes_.isPowered(), memory_.isWorn())) {
    case BoardEvent::kNone:
      break;
    case BoardEvent::kSupplyLow:
      out_ << FLASH("The Mega's supply is low: ");
      out_.fixed(watch_.supply(), 2).line(FLASH(" V. Check its plug and USB cable ($76)."));
      break;
    case BoardEvent::kWorn:
      out_.line(FLASH("The EEPROM is worn: settings may be lost with the power. Note them."));
      break;
    case BoardEvent::kDriverFails:
      return true;
  }
  return false;
}

FlashText Telemetry::failure() const {
  const Axis axis = watch_.failing();
  if (axis == kLeftAxis)
    return FLASH("The left motor's driver complains: too hot, a short, or no 12 V. Press Stop.");
  if (axis == kRightAxis)
    return FLASH("The right motor's driver complains: too hot, a short, or no 12 V. Press Stop.");
  return FLASH("The z motor's driver complains: too hot, a short, or no 12 V. Press Stop.");
}

void Telemetry::tell() {
  out_ << FLASH("[Telemetry|error:");
  for (uint8_t i = 0; i < kAxisCount; ++i) {
    if (i != 0) out_ << ',';
    out_.fixed(axes_.mostBehind(Axis(i)), 3);
  }
  out_ << FLASH("|dry:") << int32_t(mover_.timesDry());
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
  out_.line(FLASH("]"));
}

}  // namespace machine
