// Supply, drivers and EEPROM, one look at a time.
#include "board_watch.h"

namespace machine {

BoardEvent BoardWatch::look(Aux& aux, const BoardLimits& limits, bool is_powered, bool is_worn) {
  takeSupply(aux.bandGap(), limits.band_gap);
  // A driver without power may report just that.
  complaints_ = is_powered && hasComplained(aux) ? uint8_t(complaints_ + 1) : uint8_t(0);
  if (complaints_ >= kPatience) {
    complaints_ = 0;
    return BoardEvent::kDriverFails;
  }
  if (hasFallen(limits.least_supply)) return BoardEvent::kSupplyLow;
  if (!is_worn || is_wear_told_) return BoardEvent::kNone;
  is_wear_told_ = true;
  return BoardEvent::kWorn;
}

float BoardWatch::lowestSupply() {
  const float lowest = lowest_;
  lowest_ = supply_;
  return lowest;
}

void BoardWatch::takeSupply(uint16_t reading, float band_gap) {
  if (reading == 0) return;
  const float volts = band_gap * 1024 / float(reading);
  if (settling_ != 0) {
    // After the start the reference needs a while to settle.
    --settling_;
    supply_ = lowest_ = volts;
    return;
  }
  supply_ += (volts - supply_) / 4;
  if (supply_ < lowest_) lowest_ = supply_;
}

bool BoardWatch::hasFallen(float least) {
  const float kBackAgain = 0.1f;  // [V]
  if (settling_ != 0) return false;
  const bool was_low = is_low_;
  is_low_ = supply_ < (was_low ? least + kBackAgain : least);
  return is_low_ && !was_low;
}

bool BoardWatch::hasComplained(Aux& aux) {
  for (uint8_t i = 0; i < kAxisCount; ++i)
    if (aux.driverFails(Axis(i))) {
      failing_ = Axis(i);
      return true;
    }
  return false;
}

}  // namespace machine
