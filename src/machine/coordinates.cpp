// Coordinates: declared, shifted, stored and shown.
#include "coordinates.h"

namespace machine {
namespace {

const uint8_t kGoals = kFirstPlaceSetting + kKeptSystems * kPlaceAxes;

/// The first row of the place to which G28 or G30 goes.
uint8_t goalRow(const gcode::Piece& piece) {
  return piece.tenths / 10 == 28 ? kGoals : uint8_t(kGoals + kPlaceAxes);
}

}  // namespace

bool Coordinates::mayCrossSheet() const {
  return (place_.isTrusted() && place_.isKnown()) ||
         base_.answers.refuseMotion(place_.whatIsLost());
}

bool Coordinates::keep(uint8_t row, float value) {
  if (base_.memory.setRow(row, value) == settings::Refusal::kNone) return true;
  return base_.answers.refuseMotion(tooFar());
}

bool Coordinates::declare(const gcode::Words& words) {
  const bool here = words.value('L') == 20;
  if (!here && words.value('L') != 2)
    return base_.answers.refuseWords(FLASH("G10 knows L2 and L20 only"));
  const float system = words.value('P');
  if (!(system >= 0 && system <= kKeptSystems && system == float(uint8_t(system))))
    return base_.answers.refuseWords(
        FLASH("P is 1 to 6, for G54 to G59, or 0 for the coordinates in force"));
  if (here && goesAcross(words) && !mayCrossSheet()) return false;
  const uint8_t index = system == 0 ? base_.modal.system : uint8_t(system - 1);
  Place aim = base_.program.aim();
  for (uint8_t axis = 0; axis < kPlaceAxes; ++axis) {
    if (!words.has(kAxisLetters[axis])) continue;
    const float word = base_.modal.toMm(words.value(kAxisLetters[axis]));
    const float value = here ? offsets_.storedFor(axis, part(aim, axis), word) : word;
    const uint8_t row = uint8_t(kFirstPlaceSetting + index * kPlaceAxes + axis);
    if (!keep(row, value)) return false;
  }
  return true;
}

bool Coordinates::shift(const gcode::Words& words) {
  if (!words.hasPlace()) return base_.answers.refuseWords(FLASH("G92 needs X, Y or Z"));
  if (goesAcross(words) && !mayCrossSheet()) return false;
  Place aim = base_.program.aim();
  for (uint8_t axis = 0; axis < kPlaceAxes; ++axis) {
    if (!words.has(kAxisLetters[axis])) continue;
    const float word = base_.modal.toMm(words.value(kAxisLetters[axis]));
    offsets_.shiftTo(base_.modal.system, axis, part(aim, axis), word);
  }
  return true;
}

void Coordinates::forget() {
  for (uint8_t row = kFirstPlaceSetting; row < kSettingCount; ++row)
    base_.memory.setRow(row, base_.values.table().at(row).usual);
  offsets_.clearShift();
}

void Coordinates::endShift(uint16_t tenths) {
  if (tenths == 921) offsets_.clearShift();
  if (tenths == 922) offsets_.suspendShift();
  if (tenths == 923) offsets_.resumeShift();
}

bool Coordinates::takeToolLength(const gcode::Words& words) {
  if (!words.has('Z') || goesAcross(words))
    return base_.answers.refuseWords(FLASH("G43.1 needs Z, the tool's length, and nothing else"));
  offsets_.setToolLength(base_.modal.toMm(words.value('Z')));
  return true;
}

bool Coordinates::keepGoal(const gcode::Piece& piece) {
  if (piece.words.hasPlace())
    return base_.answers.refuseWords(FLASH("it keeps the place where the tool is"));
  if (!mayCrossSheet()) return false;
  const uint8_t row = goalRow(piece);
  const Place& aim = base_.program.aim();
  return keep(row, aim.x) && keep(uint8_t(row + 1), aim.y) && keep(uint8_t(row + 2), aim.z);
}

const float* Coordinates::goal(const gcode::Piece& piece) {
  const float* const kept = base_.values.from(goalRow(piece));
  if (*kept != kNoPlace) return kept;
  base_.answers.refuseWords(
      FLASH("no place is kept for it; go there first and send G28.1 or G30.1"));
  return nullptr;
}

void Coordinates::say(FlashText name, int32_t number, float x, float y, float z) {
  const uint8_t decimals = base_.modal.inches ? 4 : 2;
  base_.out << name;
  if (number != 0) base_.out << number;
  base_.out << FLASH(" X");
  base_.out.fixed(base_.modal.fromMm(x), decimals) << FLASH(" Y");
  base_.out.fixed(base_.modal.fromMm(y), decimals) << FLASH(" Z");
  base_.out.fixed(base_.modal.fromMm(z), decimals).end();
}

Place Coordinates::kept(uint8_t place) const {
  const float* const at = base_.values.from(uint8_t(kFirstPlaceSetting + place * kPlaceAxes));
  if (at[0] == kNoPlace) return {0, 0, 0};
  return {at[0], at[1], at[2]};
}

void Coordinates::show() {
  for (uint8_t place = 0; place < kKeptSystems + 2; ++place) {
    const float* const at = base_.values.from(uint8_t(kFirstPlaceSetting + place * kPlaceAxes));
    if (at[0] == kNoPlace) continue;
    const int32_t code = place < kKeptSystems ? 54 + place : 28 + 2 * (place - kKeptSystems);
    say(FLASH("G"), code, at[0], at[1], at[2]);
  }
  // For the coordinates in force, with G92 and the tool's length.
  say(FLASH("Coordinates begin at"), 0, begin(0), begin(1), begin(2));
}

}  // namespace machine
