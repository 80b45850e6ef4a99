// Takes an override and hands it on.
#include "parts.h"

namespace machine {

void LiveOverrides::take(gcode::Quick quick) {
  // A Maslow client knows only the feed override.
  if (quick > gcode::Quick::kFeedDownOne && !parts_.out.speaksGrbl()) return;
  if (now_.take(quick)) apply();
}

void LiveOverrides::reset() {
  if (now_.reset()) apply();
}

void LiveOverrides::apply() {
  parts_.axes.goAt(uint16_t(now_.shareOfPlan() * float(motion::Playback::kAllOfIt)));
  parts_.planner.boost(now_.boost(), float(now_.rapid()) * 0.01f);
  parts_.cutter.override(now_.spindle());
  // A Grbl sender reads them from the status.
  if (parts_.out.speaksGrbl()) return;
  parts_.out << FLASH("[Feed: ") << int32_t(now_.feed());
  parts_.out.line(FLASH(" %]"));
}

}  // namespace machine
