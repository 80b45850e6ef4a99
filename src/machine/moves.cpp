// Targets, arcs and edges of the sheet: from the words of a line to paths in the queue.
#include "moves.h"

namespace machine {
namespace {

using gcode::Words;

const float kLeastFeed = 1;      // [mm/min]
const float kInTheWork = 0.05f;  // [mm] below the surface: nobody lets go of a bit there

}  // namespace

void Moves::takeFeed(const Words& words) {
  if (!words.has('F')) return;
  if (modal_.inverse_time) {
    modal_.inverse_feed = words.value('F');
    return;
  }
  const float feed = modal_.toMm(words.value('F'));
  modal_.feed = feed > kLeastFeed ? feed : kLeastFeed;
}

Place Moves::targetOf(const Words& words) const {
  Place target = program_.counted();
  for (uint8_t axis = 0; axis < kPlaceAxes; ++axis) {
    if (!words.has(kAxisLetters[axis])) continue;
    float& coordinate = part(target, axis);
    coordinate =
        modal_.targetOf(coordinate, words.value(kAxisLetters[axis]), coordinates_.begin(axis));
  }
  target.z = z_.within(target.z);
  return target;
}

float Moves::feedOf(uint8_t kind) const {
  const float most = values_.at(kGreatestFeed);
  if (kind == 0) return most;
  if (modal_.inverse_time) return -modal_.inverse_feed;
  return modal_.feed > most ? most : modal_.feed;
}

bool Moves::move(uint8_t kind, const Words& words) {
  cutter_.aim(kind);
  takeFeed(words);
  Place target = targetOf(words);
  if (modal_.inverse_time && kind != 0 && !(modal_.inverse_feed > 0))
    return answers_.refuseMotion(FLASH("with G93 each line needs its F"));
  const float feed = feedOf(kind);
  if (kind < 2) return moveStraight(target, goesAcross(words), feed);
  if (!mayTurn(words) || !isNear(target) || !coordinates_.mayCrossSheet()) return false;
  const Place from = program_.counted();
  if (!z_.hasMotor()) target.z = from.z;
  return moveRound(kind == 2, {from.x, from.y}, target, words, feed);
}

bool Moves::isNear(const Place& target) {
  if (!ZAxis::reaches(target.z)) return answers_.refuseMotion(tooLongForZ());
  if (fabs(target.x) < kMostTravel && fabs(target.y) < kMostTravel) return true;
  return answers_.refuseMotion(tooFar());
}

bool Moves::mayTurn(const Words& words) {
  if (modal_.plane != 17)
    return answers_.refuseMotion(FLASH("arcs are cut in the plane of G17 only"));
  if (modal_.machine_coordinates)
    return answers_.refuseMotion(FLASH("G53 goes with G0 and G1 only"));
  if (modal_.absolute_centres && !words.has('R') && !(words.has('I') && words.has('J')))
    return answers_.refuseMotion(FLASH("with G90.1 an arc needs I and J"));
  if (words.has('P') && words.value('P') != 1)
    return answers_.refuseMotion(
        FLASH("an arc goes round once; P is left to the program that sends"));
  return true;
}

bool Moves::moveStraight(Place target, bool across, float feed) {
  if (!isNear(target) || (across && !coordinates_.mayCrossSheet())) return false;
  const float z = program_.aim().z;
  if (!z_.hasMotor() && target.z != z) {
    const float kSameDepth = 0.1f;  // [mm]
    const bool asks = float(fabs(target.z - z)) > kSameDepth;
    if (asks && !pauses_.setZByHand(target.z, target.z < coordinates_.begin(kZAxis))) return false;
    target.z = program_.aim().z;
  }
  const Place from = program_.counted();
  return queue(motion::line<float>({from.x, from.y}, {target.x, target.y}), target, feed);
}

bool Moves::goToKept(const gcode::Piece& piece) {
  const Words& words = piece.words;
  const float* const kept = coordinates_.goal(piece);
  if (kept == nullptr) return false;
  const bool all = !words.hasPlace();
  const bool across = all || goesAcross(words);
  if (!all && !goSafely(targetOf(words), across)) return false;
  Place goal = program_.counted();
  for (uint8_t axis = 0; axis < kPlaceAxes; ++axis)
    if (all || words.has(kAxisLetters[axis])) part(goal, axis) = kept[axis];
  goal.z = z_.within(goal.z);
  return goSafely(goal, across);
}

bool Moves::goSafely(const Place& target, bool across) {
  if (across && !coordinates_.mayCrossSheet()) return false;
  const float feed = values_.at(kGreatestFeed);
  Place next = program_.counted();
  next.z = target.z;
  if (target.z > program_.aim().z && !moveStraight(next, false, feed)) return false;
  next = {target.x, target.y, program_.aim().z};
  if (across && !moveStraight(next, true, feed)) return false;
  next = program_.counted();
  next.z = target.z;
  return moveStraight(next, false, feed);
}

/// An arc's centre by I and J, seen from its start [mm].
motion::Point<float> Moves::centreAhead(const Words& words, motion::Point<float> from) const {
  const motion::Point<float> centre = {modal_.toMm(words.value('I')),
                                       modal_.toMm(words.value('J'))};
  if (!modal_.absolute_centres) return centre;
  return {coordinates_.begin(0) + centre.x - from.x, coordinates_.begin(1) + centre.y - from.y};
}

bool Moves::moveRound(bool clockwise, motion::Point<float> from, const Place& target,
                      const Words& words, float feed) {
  const motion::Point<float> to = {target.x, target.y};
  const float radius = modal_.toMm(words.value('R'));
  motion::Point<float> ahead = centreAhead(words, from);
  float digit = modal_.inches ? motion::kInchDigit : motion::kMillimetreDigit;
  if (radius != 0) {
    const gcode::ArcCentre seen =
        gcode::centreByRadius(to.x - from.x, to.y - from.y, radius, clockwise,
                              modal_.inches ? gcode::kInchSpare : gcode::kMillimetreSpare);
    if (!seen.found)
      return answers_.refuseMotion(FLASH("an arc of that radius does not reach its end"));
    ahead = {seen.x, seen.y};
    digit = 0;  // the radius's sign says whether the arc is the long way round
  } else if (!words.has('I') && !words.has('J')) {
    // An arc without centre is a line, as in the published firmware.
    return queue(motion::line(from, to), target, feed);
  }
  const motion::Turn turn = clockwise ? motion::Turn::kClockwise : motion::Turn::kCounterclockwise;
  const motion::Path<float> path =
      motion::arc(from, to, {from.x + ahead.x, from.y + ahead.y}, turn, digit);
  if (path.drawn == motion::Drawn::kEndOffArc)
    return answers_.refuseMotion(FLASH("the arc does not end on its circle"));
  return queue(path, target, feed);
}

/// The feed for a move that G93 times: `times` [1/min] is 1 / its time.
float Moves::fittingFeed(const motion::Path<float>& path, const Place& target, float times) const {
  const float rise = target.z - program_.aim().z, most = values_.at(kGreatestFeed);
  const float feed = times * float(sqrt(path.length * path.length + rise * rise));
  return feed > most ? most : feed;
}

bool Moves::queue(const motion::Path<float>& path, const Place& target, float feed) {
  const uint8_t beam = cutter_.takeBeam();
  const Place& aim = program_.aim();
  // An arrow key starts where the sled is.
  const bool is_jog = modal_.relative && modal_.motion == 0;
  if (!is_jog && !door_.goesOnFromHere()) return false;
  const bool goes = path.drawn != motion::Drawn::kNoLength;
  if (!goes && target.z == aim.z) return true;
  if (target.z != aim.z && !door_.doesZFollow()) return false;
  if (goes && !door_.doChainsFollow()) return false;
  if (feed < 0) feed = fittingFeed(path, target, -feed);
  // Nearly every path is on the sheet; to look for its cuts would cost a tenth of a short line.
  const bool queued = goes && geometry_.holds(path)
                          ? queuePiece(path, motion::Space::kSheet, target.z, feed, beam)
                          : queueCut(path, target.z, feed, beam);
  if (queued) program_.countFrom(target.x, target.y);
  return queued;
}

/// Queues a path that leaves the sheet, ends where no sled may hang, or moves z alone.
bool Moves::queueCut(const motion::Path<float>& path, float z_to, float feed, uint8_t beam) {
  const Area area = geometry_.sheet().grownTo({program_.aim().x, program_.aim().y});
  const bool goes = path.drawn != motion::Drawn::kNoLength;
  if (goes && !mayGo(path, area)) return false;
  EdgeCut cut(path, area);
  return queuePieces(cut, z_to, feed, beam);
}

bool Moves::mayGo(const motion::Path<float>& path, const Area& area) {
  // [mm] A stop and stretched chains may leave the sled this far beyond the edge.
  const float kOnEdge = 1;
  const Area sheet = geometry_.sheet();
  const float beyond = sheet.distanceTo({program_.aim().x, program_.aim().y});
  const bool nearer = path.sweep == 0 && sheet.distanceTo(area.clamped(path.to)) < beyond;
  if (beyond > kOnEdge && !nearer)
    return answers_.refuseMotion(
        FLASH("beyond the sheet only straight moves that come nearer to it are done"));
  EdgeCut cut(path, area);
  const bool leaves = cut.leaves();
  while (cut.next())
    if (!geometry_.isReachable(cut.piece().to))
      return answers_.refuseMotion(FLASH("no sled can hang there"));
  if (leaves && !program_.isCountedBeyond()) sayBeyondSheet(area.clamped(path.to));
  return true;
}

void Moves::sayBeyondSheet(motion::Point<float> end) {
  out_ << FLASH("This line leads beyond the sheet: the sled keeps to the edge and ends it at X");
  out_.fixed(modal_.fromMm(end.x), 2) << FLASH(" Y");
  out_.fixed(modal_.fromMm(end.y), 2).end();
}

bool Moves::queuePieces(EdgeCut& cut, float z_to, float feed, uint8_t beam) {
  const float z_from = program_.aim().z;
  while (cut.next()) {
    const float share = cut.share();
    const float z = share == 1 ? z_to : z_from + (z_to - z_from) * share;
    if (!queuePiece(cut.piece(), geometry_.spaceOf(cut.piece()), z, feed, beam)) return false;
  }
  return true;
}

/// Waits for room in the queue: a program waits here while its moves are made.
bool Moves::queuePiece(const motion::Path<float>& piece, motion::Space space, float z, float feed,
                       uint8_t beam) {
  if (!waiting_.waitWhile([&] { return !planner_.hasRoom(); }) || !motors_.wake()) return false;
  if (!planner_.add(piece, z, feed / 60, space, beam))
    return answers_.refuseMotion(FLASH("that is no path"));
  const bool cuts = modal_.motion >= 1 && modal_.motion <= 3;
  motors_.stayOn(cuts && z < coordinates_.begin(kZAxis) - kInTheWork);
  if (piece.drawn == motion::Drawn::kYes)
    program_.endAt({piece.to.x, piece.to.y, z});
  else
    program_.endAtZ(z);
  return true;
}

}  // namespace machine
