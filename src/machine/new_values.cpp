// Which part takes over which values.
#include "new_values.h"

#include "carried_twice.h"

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
  if ((touches & (kScale | kLoops)) && axes_.prepare(values_)) place_.reconsider();
  if (touches & kLimits) planner_.prepare(values_, axes_.secondsPerTick());
  if (touches & kCutter) cutter_.off();
  if (!(touches & kGeometry)) return;
  is_geometry_stale_ = true;
  geometry_changed_ms_ = clock_.milliseconds();
}

void NewValues::arrangeDrives() {
  axes_.releaseAll();
  // A tick in between would take the change of the encoders' wiring for motion.
  const WithoutTicks hold(clock_);
  drives_.arrange(values_.at(kFeedSide) == 1, uint8_t(values_.at(kPwmFrequency)));
  axes_.forgetRawCounts();
}

void NewValues::prepareGeometry() {
  is_geometry_stale_ = false;
  geometry_.prepare(values_);
  planner_.setGeometry(geometry_);
  // A correction that was cured is news again when it comes back.
  said_twice_ &= twiceBits(values_);
}

void NewValues::sayCarriedTwice() {
  const uint8_t twice = twiceBits(values_);
  if (twice == said_twice_) return;
  said_twice_ = twice;
  // Clients show this line. They would drop a line with "[" and stop for "Message:".
  out_ << FLASH("Corrected twice: the machine adds");
  bool is_first = true;
  for (uint8_t i = 0; twice >> i != 0; ++i) {
    if (!(twice >> i & 1)) continue;
    const Carriers carriers = carriersOf(i);
    out_ << (is_first ? FLASH(" $") : FLASH(", $")) << int32_t(carriers.published);
    out_ << FLASH(" to $") << int32_t(carriers.ours);
    is_first = false;
  }
  out_.line(FLASH(". Set one of each pair to 0, in your client too."));
}

void NewValues::refreshGeometry(Search why) {
  prepareGeometry();
  sayCarriedTwice();
  place_.search(why);
  place_.reconsider();
}

void NewValues::refreshBeforeLine() {
  if (is_geometry_stale_) refreshGeometry(Search::kBeforeLine);
}

void NewValues::refreshWhenQuiet(bool is_moving) {
  if (!is_geometry_stale_ || is_moving || clock_.milliseconds() - geometry_changed_ms_ < kQuietMs)
    return;
  refreshGeometry(Search::kNewSettings);
}

}  // namespace machine
