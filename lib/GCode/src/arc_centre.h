// The centre of an arc whose radius is given.
#pragma once

#include <math.h>

namespace gcode {

/// A centre [mm], seen from the arc's start.
struct ArcCentre {
  float x, y;
  bool found;
};

// A half circle's radius in the text may be too short by this much, as numbers are rounded.
// lib/Motion lets the two radii of an arc differ by the same amount.
const float kMostShort = 0.0719f;      // [mm]
const float kMostShortShare = 0.001f;  // [1] of the radius

// A half circle's radius in precise text may be too long by this much: inches with four decimals,
// mm with three. The centre's distance from the chord is a square root, which would turn 0.001 mm
// into 0.35 mm.
const float kInchSpare = 0.0031f;        // [mm]
const float kMillimetreSpare = 0.0013f;  // [mm]

/// Centre of the arc that ends (dx, dy) [mm] from its start with that radius [mm].
///
/// A positive radius asks for the short arc, a negative radius for the long arc. There is no centre
/// if start and end are the same place, for every circle could pass there, or if they are farther
/// apart than the circle is wide. If the circle is wider than that distance by no more than
/// `half_turn_spare` [mm], the arc is a half circle.
inline ArcCentre centreByRadius(float dx, float dy, float radius, bool clockwise,
                                float half_turn_spare = kMillimetreSpare) {
  const float chord = sqrt(dx * dx + dy * dy);
  const float wide = float(fabs(radius));
  const float spare = wide - chord / 2;
  if (!(chord > 0 && wide > 0 && (spare >= -kMostShort || spare >= -kMostShortShare * wide)))
    return {0, 0, false};
  // A product, because the difference of the squares would lose the digits of a half circle.
  const float height = spare > half_turn_spare ? float(sqrt(spare * (wide + chord / 2))) : 0;
  // A short arc to the left has its centre on the left of the chord.
  const float across = (clockwise == (radius > 0) ? -height : height) / chord;
  return {dx / 2 - dy * across, dy / 2 + dx * across, true};
}

}  // namespace gcode
