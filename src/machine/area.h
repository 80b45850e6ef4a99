// The rectangle of the plane in which the sled may be.
#pragma once

#include <Motion.h>

namespace machine {

/// The sheet, or a larger area if the sled hangs beyond the sheet.
struct Area {
  motion::Point<float> low, high;  ///< [mm] the lower left and the upper right corner

  bool holds(motion::Point<float> place) const {
    return place.x >= low.x && place.x <= high.x && place.y >= low.y && place.y <= high.y;
  }

  /// Whether a place is in the area, or out of it by no more than `slack` [mm].
  bool nearlyHolds(motion::Point<float> place, float slack) const {
    return Area{{low.x - slack, low.y - slack}, {high.x + slack, high.y + slack}}.holds(place);
  }

  /// Whether the whole path is in the area; for an arc, whether its whole circle is.
  bool holds(const motion::Path<float>& path) const {
    if (!holds(path.from) || !holds(path.to)) return false;
    if (path.sweep == 0) return true;
    const motion::Point<float>& centre = path.centre;
    const float radius = path.radius + 0.5f * float(fabs(path.grows));
    return holds({centre.x - radius, centre.y - radius}) &&
           holds({centre.x + radius, centre.y + radius});
  }

  /// The place in the area that is nearest to a place.
  motion::Point<float> clamped(motion::Point<float> place) const {
    return {within(place.x, low.x, high.x), within(place.y, low.y, high.y)};
  }

  /// How far [mm] a place is out of the area.
  float distanceTo(motion::Point<float> place) const {
    const motion::Point<float> nearest = clamped(place);
    const float x = place.x - nearest.x, y = place.y - nearest.y;
    return float(sqrt(x * x + y * y));
  }

  /// The smallest larger area that holds a place too.
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
