// Status, position errors, settings and measurements, as the clients parse them.
#include "machine.h"

namespace machine {

const uint32_t kReportInterval = 200;  // [ms] clients give up after 2 s of silence

void Machine::reportWhenDue() {
  const uint32_t now = clock.milliseconds();
  if (now - last_report_ms_ < kReportInterval) return;
  last_report_ms_ = now;
  reportStatus();
  reportErrors();
}

void Machine::reportStatus() {
  const Place place = placeNow();
  const float scale = modal.inInches() ? 1 / 25.4f : 1.0f;
  const uint8_t decimals = modal.inInches() ? 4 : 2;
  out << '<' << (pausing_ ? FLASH("Pause") : isHalted() ? FLASH("Stop") : FLASH("Idle"));
  out << FLASH(",MPos:");
  out.fixed(place.x * scale, decimals) << ',';
  out.fixed(place.y * scale, decimals) << ',';
  out.fixed(place.z * scale, decimals);
  out.line(FLASH(",WPos:0.000,0.000,0.000>"));
}

void Machine::reportErrors() {
  out << FLASH("[PE:");
  out.fixed(axes.error(kLeftAxis), 2) << ',';
  out.fixed(axes.error(kRightAxis), 2) << ',';
  out << int32_t(incoming.room()) << ']';
  out.end();
}

}  // namespace machine
