// Where the centre of an arc is that is given by its radius.
#pragma once

#include <math.h>

namespace gcode {

/// A centre [mm], seen from the arc's start.
struct ArcCentre {
  float x, y;
  bool found;
};

// What the numbers' rounding in the text may take from the radius of a half circle; as much as
// lib/Motion allows an arc's ends to differ.
const float kMostShort = 0.0719f;      // [mm]
const float kMostShortShare = 0.001f;  // [1] of the radius

// What the rounding of precise text may add to it: inches with four decimals, mm with three. The
// centre's distance from the chord is a root, which would make 0.35 mm of 0.001.
const float kInchSpare = 0.0031f;        // [mm]
const float kMillimetreSpare = 0.0013f;  // [mm]

/// Centre of the arc that ends (dx, dy) [mm] from its start with that radius [mm].
///
/// A positive radius asks for the short arc, a negative one for the long. Not found if start and
/// end are one place, for every circle passes there, or if they are farther apart than the circle
/// is wide. A circle that is wider by no more than `half_turn_spare` [mm] is a half circle.
inline ArcCentre centreByRadius(float dx, float dy, float radius, bool clockwise,
                                float half_turn_spare = kMillimetreSpare) {
  const float chord = sqrt(dx * dx + dy * dy);
  const float wide = float(fabs(radius));
  const float spare = wide - chord / 2;
  if (!(chord > 0 && wide > 0 && (spare >= -kMostShort || spare >= -kMostShortShare * wide)))
    return {0, 0, false};
  // As a product, for the difference of the squares would lose the digits of a half circle.
  const float height = spare > half_turn_spare ? float(sqrt(spare * (wide + chord / 2))) : 0;
  // A short arc to the left has its centre on the left of the chord.
  const float across = (clockwise == (radius > 0) ? -height : height) / chord;
  return {dx / 2 - dy * across, dy / 2 + dx * across, true};
}

}  // namespace gcode
