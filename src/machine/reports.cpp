// Status and position errors, as the clients parse them.
#include "parts.h"

namespace machine {

bool Reports::areDue() {
  const uint32_t kInterval = 200;  // [ms] clients give up after 2 s of silence
  const uint32_t now = parts_.clock.milliseconds();
  if (now - last_ms_ < kInterval) return false;
  last_ms_ = now;
  return true;
}

void Reports::sayStatus(FlashText state, const Place& place) {
  const uint8_t decimals = parts_.modal.inches ? 4 : 2;
  parts_.out << '<' << state << FLASH(",MPos:");
  parts_.out.fixed(parts_.modal.fromMm(place.x), decimals) << ',';
  parts_.out.fixed(parts_.modal.fromMm(place.y), decimals) << ',';
  parts_.out.fixed(parts_.modal.fromMm(place.z), decimals);
  parts_.out.line(FLASH(",WPos:0.000,0.000,0.000>"));
}

/// Three coordinates [mm], in the units of reports.
void Reports::sayPlace(const Place& place) {
  const bool inches = parts_.values.at(kReportInches) != 0;
  const float unit = inches ? 1 / gcode::kMmPerInch : 1;
  const uint8_t decimals = inches ? 4 : 3;
  parts_.out.fixed(place.x * unit, decimals) << ',';
  parts_.out.fixed(place.y * unit, decimals) << ',';
  parts_.out.fixed(place.z * unit, decimals);
}

void Reports::sayErrors() {
  parts_.out << FLASH("[PE:");
  parts_.out.fixed(parts_.axes.error(kLeftAxis), 2) << ',';
  parts_.out.fixed(parts_.axes.error(kRightAxis), 2) << ',';
  parts_.out << int32_t(parts_.input.room()) << ']';
  parts_.out.end();
}

}  // namespace machine
