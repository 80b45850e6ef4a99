// Coordinates: declared, shifted, stored and shown.
#include "parts.h"

namespace machine {
namespace {

const uint8_t kGoals = kFirstPlaceSetting + kKeptSystems * kPlaceAxes;

/// The first row of the place to which G28 or G30 goes.
uint8_t goalRow(const gcode::Piece& piece) {
  return piece.tenths / 10 == 28 ? kGoals : uint8_t(kGoals + kPlaceAxes);
}

}  // namespace

Coordinates::Coordinates(Parts& parts)
    : parts_(parts), offsets_(parts.values.from(kFirstPlaceSetting)) {}

float Coordinates::begin(uint8_t axis) const { return offsets_.at(parts_.modal.system, axis); }

bool Coordinates::mayCrossSheet() const {
  return (parts_.keeper.trustsAll() && parts_.place.isKnown()) ||
         parts_.answers.refuseMotion(parts_.place.whatIsLost());
}

bool Coordinates::keep(uint8_t row, float value) {
  if (parts_.memory.setRow(row, value) == settings::Refusal::kNone) return true;
  return parts_.answers.refuseMotion(tooFar());
}

bool Coordinates::declare(const gcode::Words& words) {
  const bool here = words.value('L') == 20;
  if (!here && words.value('L') != 2)
    return parts_.answers.refuseWords(FLASH("G10 knows L2 and L20 only"));
  const float system = words.value('P');
  if (!(system >= 0 && system <= kKeptSystems && system == float(uint8_t(system))))
    return parts_.answers.refuseWords(
        FLASH("P is 1 to 6, for G54 to G59, or 0 for the coordinates in force"));
  if (here && goesAcross(words) && !mayCrossSheet()) return false;
  const uint8_t index = system == 0 ? parts_.modal.system : uint8_t(system - 1);
  Place aim = parts_.program.aim();
  for (uint8_t axis = 0; axis < kPlaceAxes; ++axis) {
    if (!words.has(kAxisLetters[axis])) continue;
    const float word = parts_.modal.toMm(words.value(kAxisLetters[axis]));
    const float value = here ? offsets_.storedFor(axis, part(aim, axis), word) : word;
    const uint8_t row = uint8_t(kFirstPlaceSetting + index * kPlaceAxes + axis);
    if (!keep(row, value)) return false;
  }
  return true;
}

bool Coordinates::shift(const gcode::Words& words) {
  if (!words.hasPlace()) return parts_.answers.refuseWords(FLASH("G92 needs X, Y or Z"));
  if (goesAcross(words) && !mayCrossSheet()) return false;
  Place aim = parts_.program.aim();
  for (uint8_t axis = 0; axis < kPlaceAxes; ++axis) {
    if (!words.has(kAxisLetters[axis])) continue;
    const float word = parts_.modal.toMm(words.value(kAxisLetters[axis]));
    offsets_.shiftTo(parts_.modal.system, axis, part(aim, axis), word);
  }
  return true;
}

void Coordinates::forget() {
  for (uint8_t row = kFirstPlaceSetting; row < kSettingCount; ++row)
    parts_.memory.setRow(row, parts_.values.table().at(row).usual);
  offsets_.clearShift();
}

void Coordinates::endShift(uint16_t tenths) {
  if (tenths == 921) offsets_.clearShift();
  if (tenths == 922) offsets_.suspendShift();
  if (tenths == 923) offsets_.resumeShift();
}

bool Coordinates::takeToolLength(const gcode::Words& words) {
  if (!words.has('Z') || goesAcross(words))
    return parts_.answers.refuseWords(FLASH("G43.1 needs Z, the tool's length, and nothing else"));
  offsets_.setToolLength(parts_.modal.toMm(words.value('Z')));
  return true;
}

bool Coordinates::keepGoal(const gcode::Piece& piece) {
  if (piece.words.hasPlace())
    return parts_.answers.refuseWords(FLASH("it keeps the place where the tool is"));
  if (!mayCrossSheet()) return false;
  const uint8_t row = goalRow(piece);
  const Place& aim = parts_.program.aim();
  return keep(row, aim.x) && keep(uint8_t(row + 1), aim.y) && keep(uint8_t(row + 2), aim.z);
}

const float* Coordinates::goal(const gcode::Piece& piece) {
  const float* const kept = parts_.values.from(goalRow(piece));
  if (*kept != kNoPlace) return kept;
  parts_.answers.refuseWords(
      FLASH("no place is kept for it; go there first and send G28.1 or G30.1"));
  return nullptr;
}

void Coordinates::say(FlashText name, int32_t number, float x, float y, float z) {
  const uint8_t decimals = parts_.modal.inches ? 4 : 2;
  parts_.out << name;
  if (number != 0) parts_.out << number;
  parts_.out << FLASH(" X");
  parts_.out.fixed(parts_.modal.fromMm(x), decimals) << FLASH(" Y");
  parts_.out.fixed(parts_.modal.fromMm(y), decimals) << FLASH(" Z");
  parts_.out.fixed(parts_.modal.fromMm(z), decimals).end();
}

Place Coordinates::kept(uint8_t place) const {
  const float* const at = parts_.values.from(uint8_t(kFirstPlaceSetting + place * kPlaceAxes));
  if (at[0] == kNoPlace) return {0, 0, 0};
  return {at[0], at[1], at[2]};
}

void Coordinates::show() {
  for (uint8_t place = 0; place < kKeptSystems + 2; ++place) {
    const float* const at = parts_.values.from(uint8_t(kFirstPlaceSetting + place * kPlaceAxes));
    if (at[0] == kNoPlace) continue;
    const int32_t code = place < kKeptSystems ? 54 + place : 28 + 2 * (place - kKeptSystems);
    say(FLASH("G"), code, at[0], at[1], at[2]);
  }
  // For the coordinates in force, with G92 and the tool's length.
  say(FLASH("Coordinates begin at"), 0, begin(0), begin(1), begin(2));
}

}  // namespace machine
