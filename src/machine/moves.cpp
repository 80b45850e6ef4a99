// Targets, arcs and edges of the sheet: from the words of a line to paths in the queue.
#include "parts.h"

namespace machine {
namespace {

using gcode::Words;

const float kLeastFeed = 1;        // [mm/min]
const float kInTheWork = 0.05f;    // [mm] below the surface, where the bit must be held
const float kMostCutOff = 0.005f;  // [mm] between a chord and its arc
const uint8_t kMostPieces = 5;     // of a line that four edges cut

/// The axes of a plane, 0 to 2: an arc turns from the first to the second, and goes evenly along
/// the third.
struct Plane {
  uint8_t first, second, along;
};

Plane planeOf(const gcode::Modal& modal) {
  const uint8_t first = modal.plane == 17 ? 0 : modal.plane == 18 ? kZAxis : 1;
  return {first, uint8_t((first + 1) % kPlaceAxes), uint8_t((first + 2) % kPlaceAxes)};
}

/// The letter of an arc's centre along an axis.
char centreLetter(uint8_t axis) { return char('I' + axis); }

motion::Point<float> inPlane(const Plane& plane, Place& place) {
  return {part(place, plane.first), part(place, plane.second)};
}

}  // namespace

void Moves::takeFeed(const Words& words) {
  if (!words.has('F')) return;
  if (parts_.modal.inverse_time) {
    parts_.modal.inverse_feed = words.value('F');
    return;
  }
  const float feed = parts_.modal.toMm(words.value('F'));
  parts_.modal.feed = feed > kLeastFeed ? feed : kLeastFeed;
}

Place Moves::targetOf(const Words& words) const {
  Place target = placeOf(words);
  target.z = parts_.z.within(target.z);
  return target;
}

/// The place of a line's words, whatever the limits of z are.
Place Moves::placeOf(const Words& words) const {
  Place target = parts_.program.counted();
  for (uint8_t axis = 0; axis < kPlaceAxes; ++axis) {
    if (!words.has(kAxisLetters[axis])) continue;
    float& coordinate = part(target, axis);
    coordinate = parts_.modal.targetOf(coordinate, words.value(kAxisLetters[axis]),
                                       parts_.coordinates.begin(axis));
  }
  return target;
}

float Moves::feedOf(uint8_t kind) const {
  const float most = parts_.values.at(kGreatestFeed);
  if (kind == 0) return most;
  if (parts_.modal.inverse_time) return -parts_.modal.inverse_feed;
  return parts_.modal.feed > most ? most : parts_.modal.feed;
}

bool Moves::move(uint8_t kind, const Words& words) {
  parts_.cutter.aim(kind);
  takeFeed(words);
  Place target = targetOf(words);
  if (parts_.modal.inverse_time && kind != 0 && !(parts_.modal.inverse_feed > 0))
    return parts_.answers.refuseWords(FLASH("with G93 each line needs its F"));
  const float feed = feedOf(kind);
  if (kind < 2) return moveStraight(target, goesAcross(words), feed);
  const bool turns_z = parts_.modal.plane != 17;
  // A limit of z cuts such an arc short, and must not move its end.
  if (turns_z) target = placeOf(words);
  if (!mayTurn(words) || !isNear(target) || !parts_.coordinates.mayCrossSheet()) return false;
  if (!turns_z && !parts_.z.hasMotor()) target.z = parts_.program.aim().z;
  return moveRound(kind, target, words, feed);
}

bool Moves::isNear(const Place& target) {
  if (!ZAxis::reaches(target.z)) return parts_.answers.refuseMotion(tooLongForZ());
  if (fabs(target.x) < kMostTravel && fabs(target.y) < kMostTravel) return true;
  return parts_.answers.refuseMotion(tooFar());
}

bool Moves::mayTurn(const Words& words) {
  const Plane plane = planeOf(parts_.modal);
  const bool has_first = words.has(centreLetter(plane.first));
  const bool has_second = words.has(centreLetter(plane.second));
  if (parts_.modal.plane != 17 && !parts_.z.hasMotor())
    return parts_.answers.refuseWords(FLASH("an arc after G18 or G19 needs a motor for z"));
  const bool has_centre = words.has('R') || has_first || has_second;
  if (parts_.modal.plane != 17 && words.hasPlace() && !has_centre)
    return parts_.answers.refuseWords(
        FLASH("an arc needs R, or a centre in its plane (G17 to G19)"));
  if (parts_.modal.machine_coordinates)
    return parts_.answers.refuseWords(FLASH("G53 goes with G0 and G1 only"));
  if (parts_.modal.absolute_centres && !words.has('R') && !(has_first && has_second))
    return parts_.answers.refuseWords(FLASH("with G90.1 an arc needs both letters of its centre"));
  if (words.has('P') && words.value('P') != 1)
    return parts_.answers.refuseWords(
        FLASH("an arc goes round once; P is left to the program that sends"));
  return true;
}

bool Moves::moveStraight(Place target, bool across, float feed) {
  if (!isNear(target) || (across && !parts_.coordinates.mayCrossSheet())) return false;
  const float z = parts_.program.aim().z;
  if (!parts_.z.hasMotor() && target.z != z) {
    const float kSameDepth = 0.1f;  // [mm]
    const bool asks = float(fabs(target.z - z)) > kSameDepth;
    if (asks &&
        !parts_.operator_lines.setZByHand(target.z, target.z < parts_.coordinates.begin(kZAxis)))
      return false;
    target.z = parts_.program.aim().z;
  }
  const Place from = parts_.program.counted();
  return queue(motion::line<float>({from.x, from.y}, {target.x, target.y}), target, feed);
}

bool Moves::goToKept(const gcode::Piece& piece) {
  const Words& words = piece.words;
  const float* const kept = parts_.coordinates.goal(piece);
  if (kept == nullptr) return false;
  const bool all = !words.hasPlace();
  const bool across = all || goesAcross(words);
  if (!all && !goSafely(targetOf(words), across)) return false;
  Place goal = parts_.program.counted();
  for (uint8_t axis = 0; axis < kPlaceAxes; ++axis)
    if (all || words.has(kAxisLetters[axis])) part(goal, axis) = kept[axis];
  goal.z = parts_.z.within(goal.z);
  return goSafely(goal, across);
}

bool Moves::goSafely(const Place& target, bool across) {
  if (across && !parts_.coordinates.mayCrossSheet()) return false;
  const float feed = parts_.values.at(kGreatestFeed);
  Place next = parts_.program.counted();
  next.z = target.z;
  if (target.z > parts_.program.aim().z && !moveStraight(next, false, feed)) return false;
  next = {target.x, target.y, parts_.program.aim().z};
  if (across && !moveStraight(next, true, feed)) return false;
  next = parts_.program.counted();
  next.z = target.z;
  return moveStraight(next, false, feed);
}

/// How far the centre of an arc is from its start along an axis, by I, J or K [mm].
float Moves::centreAhead(const Words& words, uint8_t axis) const {
  const float centre = parts_.modal.toMm(words.value(centreLetter(axis)));
  if (!parts_.modal.absolute_centres) return centre;
  Place from = parts_.program.counted();
  return parts_.coordinates.begin(axis) + centre - part(from, axis);
}

bool Moves::moveRound(uint8_t kind, const Place& target, const Words& words, float feed) {
  motion::Path<float> path;
  if (!drawRound(kind, target, words, path)) return false;
  return parts_.modal.plane == 17 ? queue(path, target, feed) : queueChords(path, target, feed);
}

/// The path of an arc in its plane; false, with a refusal, if there is none.
bool Moves::drawRound(uint8_t kind, Place target, const Words& words, motion::Path<float>& path) {
  const bool clockwise = kind == 2;
  const Plane plane = planeOf(parts_.modal);
  Place start = parts_.program.counted();
  const motion::Point<float> from = inPlane(plane, start), to = inPlane(plane, target);
  const float radius = parts_.modal.toMm(words.value('R'));
  motion::Point<float> ahead = {centreAhead(words, plane.first), centreAhead(words, plane.second)};
  float digit = parts_.modal.inches ? motion::kInchDigit : motion::kMillimetreDigit;
  if (radius != 0) {
    const gcode::ArcCentre seen =
        gcode::centreByRadius(to.x - from.x, to.y - from.y, radius, clockwise,
                              parts_.modal.inches ? gcode::kInchSpare : gcode::kMillimetreSpare);
    if (!seen.found)
      return parts_.answers.refuseWords(FLASH("an arc of that radius does not reach its end"));
    ahead = {seen.x, seen.y};
    digit = 0;  // the radius's sign says whether the arc is the long way round
  } else if (!words.has(centreLetter(plane.first)) && !words.has(centreLetter(plane.second))) {
    // An arc without centre is a line, as in the published firmware.
    path = motion::line(from, to);
    return true;
  }
  const motion::Turn turn = clockwise ? motion::Turn::kClockwise : motion::Turn::kCounterclockwise;
  path = motion::arc(from, to, {from.x + ahead.x, from.y + ahead.y}, turn, digit);
  return path.drawn != motion::Drawn::kEndOffArc ||
         parts_.answers.refuseWords(FLASH("the arc does not end on its circle"));
}

/// Queues an arc that turns z, as chords: `path` is the arc in its plane.
bool Moves::queueChords(const motion::Path<float>& path, const Place& target, float feed) {
  Place place = parts_.program.counted(), end = target;
  const uint8_t along = planeOf(parts_.modal).along;
  const float start = part(place, along), way = part(end, along) - start;
  if (feed < 0) feed = fittingFeed(path.length, way, -feed);
  // A chord of the angle a is farthest from its arc in the middle: by radius * a^2 / 8.
  const float turn = float(fabs(path.sweep));
  const uint16_t chords = uint16_t(turn * float(sqrt(path.radius / (8 * kMostCutOff)))) + 1;
  for (uint16_t chord = 1; chord <= chords; ++chord) {
    if (!awaitRoom(kMostPieces)) return false;
    if (!queueChord(path, float(chord) / float(chords), start, way, feed)) return false;
  }
  return true;
}

/// Queues a chord to a share [1] of the arc, from where the program counts.
bool Moves::queueChord(const motion::Path<float>& path, float share, float start, float way,
                       float feed) {
  const Plane plane = planeOf(parts_.modal);
  const motion::Point<float> at = motion::placeOn(path, share);
  const Place from = parts_.program.counted();
  Place to;
  part(to, plane.first) = at.x;
  part(to, plane.second) = at.y;
  part(to, plane.along) = share == 1 ? start + way : start + way * share;
  if (!isNear(to)) return false;
  to.z = parts_.z.within(to.z);
  parts_.cutter.aim(parts_.modal.motion);
  return queue(motion::line<float>({from.x, from.y}, {to.x, to.y}), to, feed);
}

/// The feed for a move that G93 times: `times` [1/min] is 1 / its time, `length` and `rise` [mm]
/// its ways in a plane and off the plane.
float Moves::fittingFeed(float length, float rise, float times) const {
  const float most = parts_.values.at(kGreatestFeed);
  const float feed = times * float(sqrt(length * length + rise * rise));
  return feed > most ? most : feed;
}

bool Moves::queue(const motion::Path<float>& path, const Place& target, float feed) {
  const uint8_t beam = parts_.cutter.takeBeam();
  const Place& aim = parts_.program.aim();
  // An arrow key starts where the sled is.
  const bool is_jog = parts_.modal.relative && parts_.modal.motion == 0;
  if (!is_jog && !parts_.motors.goOnFromHere()) return false;
  const bool goes = path.drawn != motion::Drawn::kNoLength;
  if (!goes && target.z == aim.z) return true;
  if (target.z != aim.z && !parts_.motors.doesZFollow()) return false;
  if (goes && !parts_.motors.doChainsFollow()) return false;
  if (feed < 0) feed = fittingFeed(path.length, target.z - aim.z, -feed);
  // Nearly every path is on the sheet; to look for its cuts would cost a tenth of a short line.
  const bool is_held = goes && parts_.geometry.holds(path);
  if (!awaitRoom(is_held || !goes ? 1 : kMostPieces)) return false;
  const bool queued = is_held ? queuePiece(path, motion::Space::kSheet, target.z, feed, beam)
                              : queueCut(path, target.z, feed, beam);
  if (queued) parts_.program.countFrom(target.x, target.y);
  return queued;
}

/// Queues a path that leaves the sheet, ends where no sled may hang, or moves z alone.
bool Moves::queueCut(const motion::Path<float>& path, float z_to, float feed, uint8_t beam) {
  const Area area =
      parts_.geometry.sheet().grownTo({parts_.program.aim().x, parts_.program.aim().y});
  const bool goes = path.drawn != motion::Drawn::kNoLength;
  if (goes && !mayGo(path, area)) return false;
  EdgeCut cut(path, area);
  return queuePieces(cut, z_to, feed, beam);
}

bool Moves::mayGo(const motion::Path<float>& path, const Area& area) {
  // [mm] A stop and stretched chains may leave the sled this far beyond the edge.
  const float kOnEdge = 1;
  const Area sheet = parts_.geometry.sheet();
  const float beyond = sheet.distanceTo({parts_.program.aim().x, parts_.program.aim().y});
  const bool nearer = path.sweep == 0 && sheet.distanceTo(area.clamped(path.to)) < beyond;
  if (beyond > kOnEdge && !nearer)
    return parts_.answers.refuseMotion(
        FLASH("beyond the sheet only straight moves that come nearer to it are done"));
  EdgeCut cut(path, area);
  const bool leaves = cut.leaves();
  while (cut.next())
    if (!parts_.geometry.isReachable(cut.piece().to))
      return parts_.answers.refuseMotion(FLASH("no sled can hang there"));
  if (leaves && !parts_.program.isCountedBeyond()) sayBeyondSheet(area.clamped(path.to));
  return true;
}

void Moves::sayBeyondSheet(motion::Point<float> end) {
  parts_.out << FLASH(
      "This line leads beyond the sheet: the sled keeps to the edge and ends it at X");
  parts_.out.fixed(parts_.modal.fromMm(end.x), 2) << FLASH(" Y");
  parts_.out.fixed(parts_.modal.fromMm(end.y), 2).end();
}

bool Moves::queuePieces(EdgeCut& cut, float z_to, float feed, uint8_t beam) {
  const float z_from = parts_.program.aim().z;
  while (cut.next()) {
    const float share = cut.share();
    const float z = share == 1 ? z_to : z_from + (z_to - z_from) * share;
    if (!queuePiece(cut.piece(), parts_.geometry.spaceOf(cut.piece()), z, feed, beam)) return false;
  }
  return true;
}

/// Waits for room for what edges make of a line, where little stands on the stack. The line's first
/// move has room: see Machine::loop().
bool Moves::awaitRoom(uint8_t pieces) {
  return parts_.waiting.waitWhile(
      [&] { return parts_.planner.queue().count() + pieces > motion::MoveQueue::kMost; });
}

bool Moves::queuePiece(const motion::Path<float>& piece, motion::Space space, float z, float feed,
                       uint8_t beam) {
  if (!parts_.motors.wake()) return false;
  if (!parts_.planner.add(piece, z, feed / 60, space, beam, parts_.modal.motion == 0))
    return parts_.answers.refuseWords(FLASH("that is no path"));
  const bool cuts = parts_.modal.motion >= 1 && parts_.modal.motion <= 3;
  parts_.motors.stayOn(cuts && z < parts_.coordinates.begin(kZAxis) - kInTheWork);
  if (piece.drawn == motion::Drawn::kYes)
    parts_.program.endAt({piece.to.x, piece.to.y, z});
  else
    parts_.program.endAtZ(z);
  return true;
}

}  // namespace machine
