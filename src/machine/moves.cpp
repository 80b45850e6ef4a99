// G0 to G3: from words to a path in the queue.
#include "machine.h"

namespace machine {
namespace {

const float kLeastFeed = 1;  // [mm/min]

}  // namespace

float Machine::inUnits(float mm) const { return modal_.fromMm(mm); }
float Machine::fromUnits(float value) const { return modal_.toMm(value); }

float Machine::mostZFeed() const {
  return values_.at(kZSpeed) * float(fabs(values_.at(kZPerTurn)));
}

void Machine::takeFeed(const Words& words) {
  if (!words.has('F')) return;
  const float feed = fromUnits(words.value('F'));
  modal_.feed = feed > kLeastFeed ? feed : kLeastFeed;
}

Place Machine::targetOf(const Words& words) const {
  Place target = aim_;
  const char letters[] = "XYZ";
  float* const parts[] = {&target.x, &target.y, &target.z};
  for (uint8_t i = 0; i < 3; ++i) {
    if (!words.has(letters[i])) continue;
    *parts[i] = modal_.targetOf(*parts[i], words.value(letters[i]));
  }
  target.z = withinZLimits(target.z);
  return target;
}

bool Machine::move(uint8_t kind, const Words& words) {
  takeFeed(words);
  refreshGeometry();
  Place target = targetOf(words);
  if (!(fabs(target.x) < kMostTravel && fabs(target.y) < kMostTravel &&
        fabs(target.z) < kMostTravel))
    return refuseMotion(FLASH("that is farther than any machine reaches"));
  const bool over_sheet = words.has('X') || words.has('Y') || kind > 1;
  if (over_sheet && !mayCrossSheet()) return false;
  if (values_.at(kZMotor) == 0 && target.z != aim_.z) {
    const float kSameDepth = 0.1f;  // [mm]
    const bool asks = kind < 2 && float(fabs(target.z - aim_.z)) > kSameDepth;
    if (asks && !setZByHand(target.z)) return false;
    target.z = aim_.z;
  }
  const motion::Point<float> from = {aim_.x, aim_.y}, to = {target.x, target.y};
  const float most = values_.at(kGreatestFeed);
  const float feed = kind == 0 || modal_.feed > most ? most : modal_.feed;
  if (kind < 2) return queue(motion::line(from, to), target, feed);
  return moveRound(kind == 2, from, target, words, feed);
}

bool Machine::moveRound(bool clockwise, motion::Point<float> from, const Place& target,
                        const Words& words, float feed) {
  const motion::Point<float> to = {target.x, target.y};
  const float radius = fromUnits(words.value('R'));
  motion::Point<float> ahead = {fromUnits(words.value('I')), fromUnits(words.value('J'))};
  float digit = modal_.inches ? motion::kInchDigit : motion::kMillimetreDigit;
  if (radius != 0) {
    const gcode::ArcCentre seen =
        gcode::centreByRadius(to.x - from.x, to.y - from.y, radius, clockwise,
                              modal_.inches ? gcode::kInchSpare : gcode::kMillimetreSpare);
    if (!seen.found) return refuseMotion(FLASH("an arc of that radius does not reach its end"));
    ahead = {seen.x, seen.y};
    digit = 0;  // its sign says whether it is the long way round
  } else if (!words.has('I') && !words.has('J')) {
    // As the published firmware: an arc without centre is a line.
    return queue(motion::line(from, to), target, feed);
  }
  const motion::Turn turn = clockwise ? motion::Turn::kClockwise : motion::Turn::kCounterclockwise;
  const motion::Path<float> path =
      motion::arc(from, to, {from.x + ahead.x, from.y + ahead.y}, turn, digit);
  if (path.drawn == motion::Drawn::kEndOffArc)
    return refuseMotion(FLASH("the arc does not end on its circle"));
  return queue(path, target, feed);
}

bool Machine::mayCrossSheet() {
  if (!keeper_.trustsAll()) return refuseMotion(whatIsLost());
  if (is_place_known_) return true;
  return refuseMotion(
      FLASH("the chains put the sled nowhere: set their lengths first (B06 or B08)"));
}

bool Machine::queue(const motion::Path<float>& path, const Place& target, float feed) {
  if (path.drawn == motion::Drawn::kNoLength && target.z == aim_.z) return true;
  if (!geometry_.isReachable(path.to)) return refuseMotion(FLASH("no sled can hang there"));
  while (!stopping_ && !mover_.hasRoom()) service();
  if (stopping_ || !wakeMotors()) return false;
  if (mover_.add(path, target.z, feed / 60, geometry_) != Moved::kYes)
    return refuseMotion(FLASH("that is no path"));
  aim_ = target;
  return true;
}

}  // namespace machine
