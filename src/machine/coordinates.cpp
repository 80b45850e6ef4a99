// Where coordinates begin, and places to go back to: G10, G28, G30, G43, G49, G92.
#include "machine.h"

namespace machine {
namespace {

const uint8_t kGoals = kFirstPlaceSetting + kKeptSystems * kPlaceAxes;
const char kAxisLetters[] = "XYZ";

/// The first row of the place where G28 or G30 goes.
uint8_t goalRow(const gcode::Piece& piece) {
  return piece.tenths / 10 == 28 ? kGoals : uint8_t(kGoals + kPlaceAxes);
}

float& part(Place& place, uint8_t axis) {
  return axis == 0 ? place.x : axis == 1 ? place.y : place.z;
}

bool goesAcross(const Words& words) { return words.has('X') || words.has('Y'); }

}  // namespace

bool Machine::keepCoordinate(uint8_t row, float value) {
  if (memory_.setRow(row, value) == settings::Refusal::kNone) return true;
  return refuseMotion(FLASH("that is farther than any machine reaches"));
}

bool Machine::declareByWords(const gcode::Piece& piece) {
  const Words& words = piece.words;
  if (!words.has('L')) {
    if (goesAcross(words)) return refuseMotion(FLASH("G10 with X or Y needs L2 or L20"));
    return declareZByWord(words);
  }
  const bool here = words.value('L') == 20;
  if (!here && words.value('L') != 2) return refuseMotion(FLASH("G10 knows L2 and L20 only"));
  const float system = words.value('P');
  if (!(system >= 0 && system <= kKeptSystems && system == float(uint8_t(system))))
    return refuseMotion(FLASH("P is 1 to 6, for G54 to G59, or 0 for the coordinates in force"));
  if (here && goesAcross(words) && !mayCrossSheet()) return false;
  const uint8_t index = system == 0 ? modal_.system : uint8_t(system - 1);
  for (uint8_t axis = 0; axis < kPlaceAxes; ++axis) {
    if (!words.has(kAxisLetters[axis])) continue;
    const float word = fromUnits(words.value(kAxisLetters[axis]));
    const float value = here ? offsets_.storedFor(axis, part(aim_, axis), word) : word;
    const uint8_t row = uint8_t(kFirstPlaceSetting + index * kPlaceAxes + axis);
    if (!keepCoordinate(row, value)) return false;
  }
  return true;
}

bool Machine::shiftCoordinates(const gcode::Piece& piece) {
  const Words& words = piece.words;
  if (!words.hasPlace()) return refuseMotion(FLASH("G92 needs X, Y or Z"));
  if (goesAcross(words) && !mayCrossSheet()) return false;
  for (uint8_t axis = 0; axis < kPlaceAxes; ++axis) {
    if (!words.has(kAxisLetters[axis])) continue;
    const float word = fromUnits(words.value(kAxisLetters[axis]));
    offsets_.shiftTo(modal_.system, axis, part(aim_, axis), word);
  }
  return true;
}

bool Machine::endShift(const gcode::Piece& piece) {
  if (piece.tenths == 921) offsets_.clearShift();
  if (piece.tenths == 922) offsets_.suspendShift();
  if (piece.tenths == 923) offsets_.resumeShift();
  return moveInMode(piece.words);
}

bool Machine::takeToolLength(const gcode::Piece& piece) {
  if (!piece.words.has('Z') || goesAcross(piece.words))
    return refuseMotion(FLASH("G43.1 needs Z, the tool's length, and nothing else"));
  offsets_.setToolLength(fromUnits(piece.words.value('Z')));
  return true;
}

bool Machine::forgetToolLength(const gcode::Piece& piece) {
  // G43 H too: there is no table of tools, z is set for the tool in the spindle.
  offsets_.setToolLength(0);
  return moveInMode(piece.words);
}

bool Machine::keepGoal(const gcode::Piece& piece) {
  if (piece.words.hasPlace()) return refuseMotion(FLASH("it keeps the place where the tool is"));
  if (!mayCrossSheet()) return false;
  const uint8_t row = goalRow(piece);
  return keepCoordinate(row, aim_.x) && keepCoordinate(uint8_t(row + 1), aim_.y) &&
         keepCoordinate(uint8_t(row + 2), aim_.z);
}

bool Machine::goToKept(const gcode::Piece& piece) {
  const Words& words = piece.words;
  const uint8_t row = goalRow(piece);
  if (values_.at(row) == kNoPlace)
    return refuseMotion(FLASH("nobody has set that place; go there and say G28.1 or G30.1"));
  refreshGeometry();
  const bool all = !words.hasPlace();
  const bool across = all || goesAcross(words);
  if (!all && !goSafely(targetOf(words), across)) return false;
  Place goal = counted();
  for (uint8_t axis = 0; axis < kPlaceAxes; ++axis)
    if (all || words.has(kAxisLetters[axis])) part(goal, axis) = values_.at(uint8_t(row + axis));
  goal.z = withinZLimits(goal.z);
  return goSafely(goal, across);
}

bool Machine::goSafely(const Place& target, bool across) {
  const float feed = values_.at(kGreatestFeed);
  Place next = counted();
  next.z = target.z;
  if (target.z > aim_.z && !moveStraight(next, false, feed)) return false;
  next = {target.x, target.y, aim_.z};
  if (across && !moveStraight(next, true, feed)) return false;
  next = {counted_.x, counted_.y, target.z};
  return moveStraight(next, false, feed);
}

void Machine::sayPlaceOf(FlashText name, int32_t number, float x, float y, float z) {
  const uint8_t decimals = modal_.inches ? 4 : 2;
  out_ << name;
  if (number != 0) out_ << number;
  out_ << FLASH(" X");
  out_.fixed(inUnits(x), decimals) << FLASH(" Y");
  out_.fixed(inUnits(y), decimals) << FLASH(" Z");
  out_.fixed(inUnits(z), decimals).end();
}

void Machine::showCoordinates() {
  for (uint8_t place = 0; place < kKeptSystems + 2; ++place) {
    const float* const at = values_.from(uint8_t(kFirstPlaceSetting + place * kPlaceAxes));
    if (at[0] == kNoPlace) continue;
    const int32_t code = place < kKeptSystems ? 54 + place : 28 + 2 * (place - kKeptSystems);
    sayPlaceOf(FLASH("G"), code, at[0], at[1], at[2]);
  }
  // Of the coordinates in force, with G92 and the tool's length.
  sayPlaceOf(FLASH("Coordinates begin at"), 0, offsets_.at(modal_.system, 0),
             offsets_.at(modal_.system, 1), offsets_.at(modal_.system, 2));
}

}  // namespace machine
