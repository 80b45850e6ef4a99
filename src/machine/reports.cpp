// Status, position errors, settings and measurements, as the clients parse them.
#include "machine.h"

namespace machine {

const uint32_t kReportInterval = 200;  // [ms] clients give up after 2 s of silence

void Machine::reportWhenDue() {
  const uint32_t now = clock_.milliseconds();
  if (now - last_report_ms_ < kReportInterval) return;
  last_report_ms_ = now;
  reportStatus();
  reportErrors();
}

void Machine::reportStatus() {
  const Place place = placeNow();
  const uint8_t decimals = modal_.inches ? 4 : 2;
  out_ << '<' << (interlude_.isOn() ? FLASH("Pause") : isHalted() ? FLASH("Stop") : FLASH("Idle"));
  out_ << FLASH(",MPos:");
  out_.fixed(inUnits(place.x), decimals) << ',';
  out_.fixed(inUnits(place.y), decimals) << ',';
  out_.fixed(inUnits(place.z), decimals);
  out_.line(FLASH(",WPos:0.000,0.000,0.000>"));
}

void Machine::reportErrors() {
  out_ << FLASH("[PE:");
  out_.fixed(axes_.error(kLeftAxis), 2) << ',';
  out_.fixed(axes_.error(kRightAxis), 2) << ',';
  out_ << int32_t(input_.room()) << ']';
  out_.end();
}

}  // namespace machine
