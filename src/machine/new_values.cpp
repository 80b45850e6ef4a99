// Which part takes over what.
#include "new_values.h"

namespace machine {
namespace {

const uint32_t kQuietMs = 700;  // clients send their settings about 20 a second

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
  // A tick in between would take another wiring of the encoders for motion.
  const WithoutTicks hold(clock_);
  drives_.arrange(values_.at(kFeedSide) == 1, uint8_t(values_.at(kPwmFrequency)));
  axes_.forgetRawCounts();
}

void NewValues::prepareGeometry() {
  is_geometry_stale_ = false;
  geometry_.prepare(values_);
  planner_.setGeometry(geometry_);
}

void NewValues::refreshGeometry() {
  if (!is_geometry_stale_) return;
  prepareGeometry();
  place_.search();
  place_.reconsider();
}

void NewValues::refreshWhenQuiet(bool is_moving) {
  if (!is_geometry_stale_ || is_moving || clock_.milliseconds() - geometry_changed_ms_ < kQuietMs)
    return;
  refreshGeometry();
  if (place_.trustsChains()) place_.find();
}

}  // namespace machine
