// For short moves in a row: a tile of exact places serves many of them.
#pragma once

#include "sprockets.h"
#include "tile.h"

namespace motion {

/// The area around the origin where the exact inverse is smooth: half its width and height [mm].
/// All zero: no such area is known, and the exact inverse is asked for every place.
struct SmoothArea {
  float half_width, half_height;
};

/// The present tile, and where and when the next is laid.
///
/// A tile costs nine inverses at once and serves until the path leaves it. So it is laid for short
/// moves only, a little ahead, and only while enough set-points wait for the tick.
class Tiles {
 public:
  /// Takes over the area, and drops the tile.
  void setArea(const SmoothArea& area) {
    area_ = area;
    tile_.forget();
  }

  /// Whether there is time for nine inverses now.
  void setTime(bool has_time) { has_time_ = has_time; }

  /// Lengths at a place on a path: from the tile if it holds the place, else from a new tile or the
  /// exact inverse.
  template <class Inverse>
  Reached lengthsAt(Point<float> place, const Path<float>& path, const Sprockets<float>& sprockets,
                    const Inverse& inverse) {
    if (tile_.holds(place)) return {tile_.at(place), true};
    if (has_time_ && isOver(place) && tile_.lay(squareAt(place, path, sprockets), inverse))
      return {tile_.at(place), true};
    return knotAt(inverse, place);
  }

 private:
  bool isOver(Point<float> place) const {
    const bool has_room =
        area_.half_width > kLargestHalfTile && area_.half_height > kLargestHalfTile;
    return has_room && fabs(place.x) <= area_.half_width && fabs(place.y) <= area_.half_height;
  }

  static float within(float value, float most) {
    return value > most ? most : value < -most ? -most : value;
  }

  /// The square that begins just behind a place and lies within the area.
  Square squareAt(Point<float> place, const Path<float>& path,
                  const Sprockets<float>& sprockets) const {
    const float to_left = path_detail::distance(place, sprockets.left);
    const float to_right = path_detail::distance(place, sprockets.right);
    const float half = halfTile(to_left < to_right ? to_left : to_right, sprockets.effects);
    const float kAhead = 0.8f;  // [1] of half the side; the rest is for paths that turn back
    const float ahead = kAhead * half / path.length;
    return {{within(place.x + (path.to.x - path.from.x) * ahead, area_.half_width - half),
             within(place.y + (path.to.y - path.from.y) * ahead, area_.half_height - half)},
            half};
  }

  Tile tile_;
  SmoothArea area_ = {0, 0};
  bool has_time_ = false;
};

}  // namespace motion
