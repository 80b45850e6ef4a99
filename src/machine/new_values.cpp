// Which part takes over which values.
#include "carried_twice.h"
#include "parts.h"

namespace machine {
namespace {

const uint32_t kQuietMs = 700;  // clients send their settings about 20 a second

/// A bit for each correction that two settings carry.
uint8_t twiceBits(const settings::Values& values) {
  uint8_t bits = 0;
  for (uint8_t i = 0; carriersOf(i).published != 0; ++i)
    if (areBothSet(values, carriersOf(i))) bits = uint8_t(bits | 1 << i);
  return bits;
}

}  // namespace

void NewValues::takeAll() {
  take(uint8_t(kAll & ~settings::kGeometry));
  prepareGeometry();
}

void NewValues::take(uint8_t touches) {
  using namespace settings;
  if (touches & kDrives) arrangeDrives();
  if ((touches & (kScale | kLoops)) && parts_.axes.prepare(parts_.values))
    parts_.keeper.reconsider();
  if (touches & kLimits) parts_.planner.prepare(parts_.values, parts_.axes.secondsPerTick());
  if (touches & kCutter) parts_.cutter.off();
  if (!(touches & kGeometry)) return;
  is_geometry_stale_ = true;
  geometry_changed_ms_ = parts_.clock.milliseconds();
}

void NewValues::arrangeDrives() {
  parts_.axes.releaseAll();
  // A tick in between would take the change of the encoders' wiring for motion.
  const WithoutTicks hold(parts_.clock);
  parts_.drives.arrange(parts_.values.at(kFeedSide) == 1, uint8_t(parts_.values.at(kPwmFrequency)));
  parts_.axes.forgetRawCounts();
}

void NewValues::prepareGeometry() {
  is_geometry_stale_ = false;
  parts_.geometry.prepare(parts_.values);
  parts_.planner.setGeometry(parts_.geometry);
  // A correction that was set right is reported again if it comes back.
  said_twice_ &= twiceBits(parts_.values);
}

void NewValues::sayCarriedTwice() {
  const uint8_t twice = twiceBits(parts_.values);
  if (twice == said_twice_) return;
  said_twice_ = twice;
  // Clients show this line. They would drop a line with "[" and stop for "Message:".
  parts_.out << FLASH("Corrected twice: the machine adds");
  bool is_first = true;
  for (uint8_t i = 0; twice >> i != 0; ++i) {
    if (!(twice >> i & 1)) continue;
    const Carriers carriers = carriersOf(i);
    parts_.out << (is_first ? FLASH(" $") : FLASH(", $")) << int32_t(carriers.published);
    parts_.out << FLASH(" to $") << int32_t(carriers.ours);
    is_first = false;
  }
  parts_.out.line(FLASH(". Set one of each pair to 0, in your client too."));
}

void NewValues::refreshGeometry(Search why) {
  prepareGeometry();
  sayCarriedTwice();
  parts_.place.search(why);
  parts_.keeper.reconsider();
}

void NewValues::refreshBeforeLine() {
  if (is_geometry_stale_) refreshGeometry(Search::kBeforeLine);
}

void NewValues::refreshWhenQuiet(bool is_moving) {
  if (!is_geometry_stale_ || is_moving ||
      parts_.clock.milliseconds() - geometry_changed_ms_ < kQuietMs)
    return;
  refreshGeometry(Search::kNewSettings);
}

}  // namespace machine
