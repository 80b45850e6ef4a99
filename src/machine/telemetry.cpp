// B30: how the machine is doing, in a line that clients pass over; and what the board's watch says.
#include "machine.h"

namespace machine {

void Machine::watchBoard() {
  const uint32_t now = clock_.milliseconds();
  if (now - board_looked_ms_ < BoardWatch::kInterval) return;
  board_looked_ms_ = now;
  const BoardLimits limits = {values_.at(kBandGap), values_.at(kLeastSupply)};
  switch (board_watch_.look(aux_, limits, axes_.isPowered(), memory_.isWorn())) {
    case BoardEvent::kNone:
      return;
    case BoardEvent::kSupplyLow:
      out_ << FLASH("The Mega's supply is low: ");
      out_.fixed(board_watch_.supply(), 2).line(FLASH(" V. Check its plug and USB cable ($76)."));
      return;
    case BoardEvent::kWorn:
      return out_.line(
          FLASH("The EEPROM is worn: settings may be lost with the power. Note them."));
    case BoardEvent::kDriverFails:
      return raiseAlarm(driverText(board_watch_.failing()));
  }
}

FlashText Machine::driverText(Axis axis) {
  if (axis == kLeftAxis)
    return FLASH("The left motor's driver complains: too hot, a short, or no 12 V. Press Stop.");
  if (axis == kRightAxis)
    return FLASH("The right motor's driver complains: too hot, a short, or no 12 V. Press Stop.");
  return FLASH("The z motor's driver complains: too hot, a short, or no 12 V. Press Stop.");
}

bool Machine::tellTelemetry() {
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
  out_.fixed(board_watch_.supply(), 2) << ',';
  out_.fixed(board_watch_.lowestSupply(), 2);
  out_ << (memory_.isWorn() ? FLASH("|eeprom:worn") : FLASH("|eeprom:ok"));
  out_ << FLASH("|start:");
  out_ << (board_.start == Start::kUsual      ? FLASH("usual")
           : board_.start == Start::kBrownOut ? FLASH("brown-out")
                                              : FLASH("watchdog"));
  out_.line(FLASH("]"));
  return true;
}

}  // namespace machine
