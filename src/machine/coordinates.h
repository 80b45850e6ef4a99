// Where a program's coordinates begin, and the places to which G28 and G30 go.
#pragma once

#include "sled_place.h"

namespace machine {

/// G10 L2 and L20, G28.1, G30.1, G43.1, G49, G92, and `$#`. Moves nothing.
class Coordinates {
 public:
  explicit Coordinates(Parts& parts);

  /// [mm] Where the coordinate of an axis begins, in the system in force.
  float begin(uint8_t axis) const;

  /// Whether the sled may cross the sheet; refuses the line if not.
  bool mayCrossSheet() const;

  /// G10 with L.
  bool declare(const gcode::Words& words);
  /// G92.
  bool shift(const gcode::Words& words);
  /// G92.1 to G92.3.
  void endShift(uint16_t tenths);
  /// G43.1.
  bool takeToolLength(const gcode::Words& words);
  void forgetToolLength() { offsets_.setToolLength(0); }
  /// G28.1 and G30.1.
  bool keepGoal(const gcode::Piece& piece);
  /// The place to which G28 or G30 goes, x, y and z [mm]. Null, with a refusal, if it was never
  /// set.
  const float* goal(const gcode::Piece& piece);
  /// `$#`.
  void show();
  /// Forgets G54 to G59, G28, G30 and G92.
  void forget();
  /// Kept places: 0 to 5 are the beginnings of G54 to G59, 6 and 7 those to which G28 and
  /// G30 go; 0,0,0 where none is kept [mm].
  Place kept(uint8_t place) const;
  const gcode::WorkOffsets& offsets() const { return offsets_; }

 private:
  bool keep(uint8_t row, float value);
  void say(FlashText name, int32_t number, float x, float y, float z);

  Parts& parts_;
  gcode::WorkOffsets offsets_;
};

/// Whether a line moves along the sheet.
inline bool goesAcross(const gcode::Words& words) { return words.has('X') || words.has('Y'); }

/// Letters of the axes and of a place's coordinates, by 0, 1, 2.
const char kAxisLetters[] = "XYZ";
inline float& part(Place& place, uint8_t axis) {
  return axis == 0 ? place.x : axis == 1 ? place.y : place.z;
}

}  // namespace machine
