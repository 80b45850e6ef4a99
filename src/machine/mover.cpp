// Look-ahead over the queue, speed from tick to tick, knots by the exact inverse.
#include "mover.h"

#include "settings_table.h"

namespace machine {
namespace {

// Paths of fewer ticks than this ask the exact inverse at each; longer ones at knots.
const float kFewTicks = 3;

float smaller(float a, float b) { return a < b ? a : b; }

}  // namespace

void Mover::prepare(const settings::Values& values, float seconds_per_tick) {
  seconds_ = seconds_per_tick;
  limits_.gain_xy = values.at(kAccelerationXy);
  limits_.gain_z = values.at(kAccelerationZ);
  limits_.speed_xy = smaller(values.at(kGreatestFeed), values.at(kChainSpeed)) / 60;
  limits_.speed_z = values.at(kZSpeed) * float(fabs(values.at(kZPerTurn))) / 60;
  limits_.corner_deviation = values.at(kCornerDeviation);
}

Moved Mover::add(const motion::Path<float>& path, float z_to, float feed) {
  const bool has_path = path.drawn == motion::Drawn::kYes;
  if (!has_path && path.drawn != motion::Drawn::kNoLength) return Moved::kNoPath;
  const float rise = z_to - z_end_;
  if (!has_path && rise == 0) return Moved::kYes;
  Block& block = at(count_);
  block.path = path;
  if (!has_path) block.path.length = 0;
  block.z_from = z_end_;
  block.z_to = z_to;
  const float along = block.path.length;
  block.length = rise == 0 ? along : float(sqrt(along * along + rise * rise));
  const float xy = along / block.length, z = float(fabs(rise)) / block.length;
  float top = smaller(feed, xy > 0 ? limits_.speed_xy / xy : feed);
  block.gain = xy > 0 ? limits_.gain_xy / xy : limits_.gain_z;
  if (z > 0) {
    top = smaller(top, limits_.speed_z / z);
    block.gain = smaller(block.gain, limits_.gain_z / z);
  }
  block.top_squared = top * top;
  // Round an arc the sled is pulled inwards all the way.
  if (has_path && path.sweep != 0)
    block.top_squared = smaller(block.top_squared, limits_.gain_xy * path.radius / (xy * xy));
  const motion::Point<float> end = directionOf(block.path, true);
  block.dx = end.x * xy;
  block.dy = end.y * xy;
  block.dz = rise / block.length;
  limitEntry(block);
  z_end_ = z_to;
  ++count_;
  lookAhead();
  return Moved::kYes;
}

void Mover::limitEntry(Block& block) {
  block.entry_limit = 0;
  block.entry_squared = 0;
  if (count_ == 0) return;
  const Block& before = at(uint8_t(count_ - 1));
  const motion::Point<float> begin = directionOf(block.path, false);
  const float xy = block.path.length / block.length;
  const float cosine = before.dx * begin.x * xy + before.dy * begin.y * xy + before.dz * block.dz;
  const float gain = smaller(before.gain, block.gain);
  const float corner = cornerSpeedSquared(cosine, gain, limits_.corner_deviation);
  block.entry_limit = smaller(corner, smaller(before.top_squared, block.top_squared));
}

void Mover::lookAhead() {
  // Backwards from a stop at the end; where nothing changes, nothing before it does.
  float exit_squared = 0;
  for (uint8_t i = count_; i-- > 1;) {
    Block& block = at(i);
    const float entry = smaller(block.entry_limit, exit_squared + 2 * block.gain * block.length);
    if (entry == block.entry_squared && uint8_t(i + 1) != count_) return;
    block.entry_squared = entry;
    exit_squared = entry;
  }
}

float Mover::nextSpeed(const Block& block) {
  const float gained = block.gain * seconds_;
  if (braking_) return speed_ > gained ? speed_ - gained : 0;
  const float exit_squared = count_ > 1 ? at(1).entry_squared : 0;
  const float left = block.length - done_;
  // What can still be braked after a tick at that speed: v^2 = exit^2 + 2 gain (left - v tick).
  const float may = float(sqrt(gained * gained + exit_squared + 2 * block.gain * left)) - gained;
  float speed = speed_ + gained;
  if (speed > may) speed = may;
  if (speed * speed > block.top_squared) speed = float(sqrt(block.top_squared));
  return speed;
}

void Mover::dropFirst() {
  first_ = uint8_t(first_ + 1) % kMost;
  --count_;
  segment_.forget();
}

bool Mover::placeAt(const Block& block, const Geometry& geometry, SetPoint& point) {
  const float share = done_ / block.length;
  point.z = motion::toCounts(share >= 1 ? block.z_to
                                        : block.z_from + (block.z_to - block.z_from) * share);
  if (block.path.length == 0) return true;
  const auto exactly = [&geometry](motion::Point<float> place) { return geometry.inverse(place); };
  const auto knotAlong = [&](float along) {
    return motion::knotAt(exactly, placeOn(block.path, along / block.path.length));
  };
  const float along = share >= 1 ? block.path.length : share * block.path.length;
  if (!segment_.holds(along)) {
    const float few = kFewTicks * seconds_ * float(sqrt(block.top_squared));
    const float rest = block.path.length - along;
    if (rest < few) {
      const motion::Reached here = knotAlong(along);
      point.left = here.knot.left;
      point.right = here.knot.right;
      return here.reachable;
    }
    const float longest = motion::longestSegment(
        motion::thirdSlope(block.path.curvature(), geometry.surroundings(block.path)));
    const float length = smaller(longest, rest);
    const motion::Reached from = knotAlong(along), middle = knotAlong(along + length / 2),
                          to = knotAlong(along + length);
    if (!from.reachable || !middle.reachable || !to.reachable) return false;
    segment_.draw(along, length, from.knot, middle.knot, to.knot);
  }
  const motion::Knot knot = segment_.at(along);
  point.left = knot.left;
  point.right = knot.right;
  return true;
}

bool Mover::advance(const Geometry& geometry, SetPoint& point) {
  const float speed = nextSpeed(at(0));
  done_ += speed * seconds_;
  speed_ = speed;
  while (done_ >= at(0).length) {
    if (count_ == 1) {
      done_ = at(0).length;
      const bool reachable = placeAt(at(0), geometry, point);
      dropFirst();
      done_ = speed_ = 0;
      return reachable;
    }
    done_ -= at(0).length;
    dropFirst();
  }
  if (braking_ && speed == 0) {
    forget();
    return true;
  }
  return placeAt(at(0), geometry, point);
}

Moved Mover::fill(Axes& axes, const Geometry& geometry) {
  while (count_ != 0 && axes.hasRoom()) {
    if (!advance(geometry, last_)) return Moved::kOutOfReach;
    axes.push(last_);
  }
  if (count_ == 0) braking_ = false;
  return Moved::kYes;
}

void Mover::forget() {
  count_ = 0;
  done_ = speed_ = 0;
  braking_ = false;
  segment_.forget();
}

void Mover::standAt(const SetPoint& point) {
  forget();
  last_ = point;
  z_end_ = motion::toMm<float>(point.z);
}

}  // namespace machine
