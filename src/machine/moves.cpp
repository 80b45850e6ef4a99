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
  if (modal_.inverse_time) {
    modal_.inverse_feed = words.value('F');
    return;
  }
  const float feed = fromUnits(words.value('F'));
  modal_.feed = feed > kLeastFeed ? feed : kLeastFeed;
}

Place Machine::counted() const { return {counted_.x, counted_.y, aim_.z}; }

Place Machine::targetOf(const Words& words) const {
  Place target = counted();
  const char letters[] = "XYZ";
  float* const parts[] = {&target.x, &target.y, &target.z};
  for (uint8_t i = 0; i < 3; ++i) {
    if (!words.has(letters[i])) continue;
    *parts[i] = modal_.targetOf(*parts[i], words.value(letters[i]), offsets_.at(modal_.system, i));
  }
  target.z = withinZLimits(target.z);
  return target;
}

bool Machine::move(uint8_t kind, const Words& words) {
  cutter_.aim(kind);
  takeFeed(words);
  refreshGeometry();
  // After a rest at the edge a jog starts where the sled is.
  if (modal_.relative && !axes_.isPowered()) counted_ = {aim_.x, aim_.y};
  Place target = targetOf(words);
  if (modal_.inverse_time && kind != 0 && !(modal_.inverse_feed > 0))
    return refuseMotion(FLASH("with G93 each line needs its F"));
  const float most = values_.at(kGreatestFeed);
  const float feed = kind == 0             ? most
                     : modal_.inverse_time ? -modal_.inverse_feed
                     : modal_.feed > most  ? most
                                           : modal_.feed;
  if (kind < 2) return moveStraight(target, words.has('X') || words.has('Y'), feed);
  if (!mayTurn(words) || !isNear(target) || !mayCrossSheet()) return false;
  if (values_.at(kZMotor) == 0) target.z = aim_.z;
  return moveRound(kind == 2, counted_, target, words, feed);
}

bool Machine::isNear(const Place& target) {
  if (fabs(target.x) < kMostTravel && fabs(target.y) < kMostTravel && fabs(target.z) < kMostTravel)
    return true;
  return refuseMotion(FLASH("that is farther than any machine reaches"));
}

bool Machine::mayTurn(const Words& words) {
  if (modal_.plane != 17) return refuseMotion(FLASH("arcs are cut in the plane of G17 only"));
  if (modal_.machine_coordinates) return refuseMotion(FLASH("G53 goes with G0 and G1 only"));
  if (modal_.absolute_centres && !words.has('R') && !(words.has('I') && words.has('J')))
    return refuseMotion(FLASH("with G90.1 an arc needs I and J"));
  if (words.has('P') && words.value('P') != 1)
    return refuseMotion(FLASH("an arc goes round once; P is left to the program that sends"));
  return true;
}

bool Machine::moveStraight(Place target, bool across, float feed) {
  if (!isNear(target) || (across && !mayCrossSheet())) return false;
  if (values_.at(kZMotor) == 0 && target.z != aim_.z) {
    const float kSameDepth = 0.1f;  // [mm]
    const bool asks = float(fabs(target.z - aim_.z)) > kSameDepth;
    if (asks && !setZByHand(target.z)) return false;
    target.z = aim_.z;
  }
  return queue(motion::line<float>(counted_, {target.x, target.y}), target, feed);
}

motion::Point<float> Machine::centreAhead(const Words& words, motion::Point<float> from) const {
  const motion::Point<float> centre = {fromUnits(words.value('I')), fromUnits(words.value('J'))};
  if (!modal_.absolute_centres) return centre;
  return {offsets_.at(modal_.system, 0) + centre.x - from.x,
          offsets_.at(modal_.system, 1) + centre.y - from.y};
}

bool Machine::moveRound(bool clockwise, motion::Point<float> from, const Place& target,
                        const Words& words, float feed) {
  const motion::Point<float> to = {target.x, target.y};
  const float radius = fromUnits(words.value('R'));
  motion::Point<float> ahead = centreAhead(words, from);
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

float Machine::feedOf(const motion::Path<float>& path, const Place& target, float times) const {
  const float rise = target.z - aim_.z, most = values_.at(kGreatestFeed);
  const float feed = times * float(sqrt(path.length * path.length + rise * rise));
  return feed > most ? most : feed;
}

bool Machine::queue(const motion::Path<float>& path, const Place& target, float feed) {
  const uint8_t beam = cutter_.takeBeam();
  const bool goes = path.drawn != motion::Drawn::kNoLength;
  if (!goes && target.z == aim_.z) return true;
  if (feed < 0) feed = feedOf(path, target, -feed);
  const Area area = geometry_.sheet().grownTo({aim_.x, aim_.y});
  if (goes && !mayGo(path, area)) return false;
  if (!queuePieces(EdgeCut(path, area), target.z, feed, beam)) return false;
  counted_ = {target.x, target.y};
  return true;
}

bool Machine::mayGo(const motion::Path<float>& path, const Area& area) {
  const float kOnEdge = 1;  // [mm] what stop and stretch may leave a sled beyond it
  const Area sheet = geometry_.sheet();
  // Nearly every line; the rest costs a thousand cycles.
  if (sheet.holds(path) && geometry_.isReachable(path.to)) return true;
  const float beyond = sheet.distanceTo({aim_.x, aim_.y});
  const bool nearer = path.sweep == 0 && sheet.distanceTo(area.clamped(path.to)) < beyond;
  if (beyond > kOnEdge && !nearer)
    return refuseMotion(
        FLASH("beyond the sheet only straight moves that come nearer to it are done"));
  EdgeCut cut(path, area);
  const bool was_beyond = counted_.x != aim_.x || counted_.y != aim_.y;
  const bool leaves = cut.leaves();
  while (cut.next())
    if (!geometry_.isReachable(cut.piece().to))
      return refuseMotion(FLASH("no sled can hang there"));
  if (leaves && !was_beyond) sayBeyondSheet(area.clamped(path.to));
  return true;
}

void Machine::sayBeyondSheet(motion::Point<float> end) {
  out_ << FLASH("This line leads beyond the sheet: the sled keeps to the edge and ends it at X");
  out_.fixed(inUnits(end.x), 2) << FLASH(" Y");
  out_.fixed(inUnits(end.y), 2).end();
}

bool Machine::queuePieces(EdgeCut cut, float z_to, float feed, uint8_t beam) {
  const float z_from = aim_.z;
  while (cut.next()) {
    while (!stopping_ && !mover_.hasRoom()) serveAndSleep();
    if (stopping_ || !wakeMotors()) return false;
    const float share = cut.share();
    const float z = share == 1 ? z_to : z_from + (z_to - z_from) * share;
    if (mover_.add(cut.piece(), z, feed / 60, geometry_, beam) != Moved::kYes)
      return refuseMotion(FLASH("that is no path"));
    if (cut.piece().drawn == motion::Drawn::kYes)
      aim_ = {cut.piece().to.x, cut.piece().to.y, z};
    else
      aim_.z = z;
  }
  return true;
}

}  // namespace machine
