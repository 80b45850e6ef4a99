// Status and position errors, as the clients parse them.
#include "reports.h"

namespace machine {

bool Reports::areDue() {
  const uint32_t kInterval = 200;  // [ms] clients give up after 2 s of silence
  const uint32_t now = clock_.milliseconds();
  if (now - last_ms_ < kInterval) return false;
  last_ms_ = now;
  return true;
}

void Reports::sayStatus(FlashText state, const Place& place) {
  const uint8_t decimals = modal_.inches ? 4 : 2;
  out_ << '<' << state << FLASH(",MPos:");
  out_.fixed(modal_.fromMm(place.x), decimals) << ',';
  out_.fixed(modal_.fromMm(place.y), decimals) << ',';
  out_.fixed(modal_.fromMm(place.z), decimals);
  out_.line(FLASH(",WPos:0.000,0.000,0.000>"));
}

void Reports::sayErrors() {
  out_ << FLASH("[PE:");
  out_.fixed(axes_.error(kLeftAxis), 2) << ',';
  out_.fixed(axes_.error(kRightAxis), 2) << ',';
  out_ << int32_t(input_.room()) << ']';
  out_.end();
}

}  // namespace machine
