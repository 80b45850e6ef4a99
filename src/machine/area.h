// The rectangle of the plane in which the sled may be.
#pragma once

#include <Motion.h>

namespace machine {

/// The sheet, or the sheet grown to where the sled hangs beyond it.
struct Area {
  motion::Point<float> low, high;  ///< [mm] its corners at the lower left and the upper right

  /// Whether a place is in it, or out of it by no more than `slack` [mm].
  bool holds(motion::Point<float> place, float slack = 0) const {
    return place.x >= low.x - slack && place.x <= high.x + slack && place.y >= low.y - slack &&
           place.y <= high.y + slack;
  }

  /// Whether no place of a path is out of it; of an arc its whole circle is asked.
  bool holds(const motion::Path<float>& path) const {
    if (!holds(path.from) || !holds(path.to)) return false;
    if (path.sweep == 0) return true;
    const motion::Point<float>& centre = path.centre;
    const float radius = path.radius + 0.5f * float(fabs(path.grows));
    return holds({centre.x - radius, centre.y - radius}) &&
           holds({centre.x + radius, centre.y + radius});
  }

  /// A place brought back to the nearest in it.
  motion::Point<float> clamped(motion::Point<float> place) const {
    return {within(place.x, low.x, high.x), within(place.y, low.y, high.y)};
  }

  /// How far [mm] out of it a place is.
  float distanceTo(motion::Point<float> place) const {
    const motion::Point<float> nearest = clamped(place);
    const float x = place.x - nearest.x, y = place.y - nearest.y;
    return float(sqrt(x * x + y * y));
  }

  /// The same, as much larger as it must be to hold a place.
  Area grownTo(motion::Point<float> place) const {
    return {{place.x < low.x ? place.x : low.x, place.y < low.y ? place.y : low.y},
            {place.x > high.x ? place.x : high.x, place.y > high.y ? place.y : high.y}};
  }

 private:
  static float within(float value, float least, float most) {
    return value < least ? least : value > most ? most : value;
  }
};

}  // namespace machine
