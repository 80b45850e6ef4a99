// Status and position errors, as the clients parse them.
#include "reports.h"

namespace machine {

bool Reports::areDue() {
  const uint32_t kInterval = 200;  // [ms] clients give up after 2 s of silence
  const uint32_t now = base_.clock.milliseconds();
  if (now - last_ms_ < kInterval) return false;
  last_ms_ = now;
  return true;
}

void Reports::sayStatus(FlashText state, const Place& place) {
  const uint8_t decimals = base_.modal.inches ? 4 : 2;
  base_.out << '<' << state << FLASH(",MPos:");
  base_.out.fixed(base_.modal.fromMm(place.x), decimals) << ',';
  base_.out.fixed(base_.modal.fromMm(place.y), decimals) << ',';
  base_.out.fixed(base_.modal.fromMm(place.z), decimals);
  base_.out.line(FLASH(",WPos:0.000,0.000,0.000>"));
}

/// Three coordinates [mm], in the units of reports.
void Reports::sayPlace(const Place& place) {
  const bool inches = base_.values.at(kReportInches) != 0;
  const float unit = inches ? 1 / gcode::kMmPerInch : 1;
  const uint8_t decimals = inches ? 4 : 3;
  base_.out.fixed(place.x * unit, decimals) << ',';
  base_.out.fixed(place.y * unit, decimals) << ',';
  base_.out.fixed(place.z * unit, decimals);
}

void Reports::sayErrors() {
  base_.out << FLASH("[PE:");
  base_.out.fixed(base_.axes.error(kLeftAxis), 2) << ',';
  base_.out.fixed(base_.axes.error(kRightAxis), 2) << ',';
  base_.out << int32_t(base_.input.room()) << ']';
  base_.out.end();
}

}  // namespace machine
