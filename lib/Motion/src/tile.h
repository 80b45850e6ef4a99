// A small square of the sheet: nine exact places in it give the chains' lengths at all others.
#pragma once

#include "bound.h"
#include "fixed.h"

namespace motion {

/// The middle of a square and half its side [mm].
struct Square {
  Point<float> middle;
  float half;
};

inline bool holds(const Square& square, Point<float> place) {
  return fabs(place.x - square.middle.x) <= square.half &&
         fabs(place.y - square.middle.y) <= square.half;
}

// Largest error of a tile. With rounding its lengths stay within 0.0015 mm.
const float kMostMissedInTile = 0.0005f;  // [mm]
const float kLargestHalfTile = 15;        // [mm]

/// Half the side [mm] of a tile near places that are `nearest` [mm] from a sprocket.
///
/// Nine places make a quadratic in x whose three values are quadratics in y. Along x its error is
/// that of a quadratic over a side. Along y it is 1.25 times that error, because the three values
/// may all be wrong and their weights add up to at most 1.25. Together that is 2.25 times third
/// slope * side^3 / 124.7.
inline float halfTile(float nearest, const Slopes<float>& effects) {
  // The tile begins behind the place, and its far corner is up to 0.8 + sqrt 2 half sides away.
  const float clear = nearest - 2.3f * kLargestHalfTile;
  const float third = thirdSlope(0.0f, Surroundings<float>{clear > 1 ? clear : 1, effects});
  const float half = 0.5f * float(cbrt(kMostMissedInTile * 124.7077f / 2.25f / third));
  return half < kLargestHalfTile ? half : kLargestHalfTile;
}

/// Lengths by a quadratic for each chain: the length less that in the middle, in counts.
class Tile {
 public:
  /// Whether a place is in the tile. A tile that was never laid, or not completely, holds none.
  bool holds(Point<float> place) const { return motion::holds(square_, place); }

  void forget() { square_.half = -1; }

  /// Asks the exact inverse at nine places of the square; false, and no tile, if any is refused.
  template <class Inverse>
  __attribute__((noinline)) bool lay(const Square& square, const Inverse& inverse);

  /// Both lengths at a place in the tile.
  Knot at(Point<float> place) const {
    const float across = (place.x - square_.middle.x) * per_half_;
    const float up = (place.y - square_.middle.y) * per_half_;
    return {middle_.left + left_.at(across, up), middle_.right + right_.at(across, up)};
  }

 private:
  enum : uint8_t { kColumns = 3 };

  /// A chain's length less that in the middle: powers of `across`, each a quadratic in `up`.
  struct Powers {
    float constant[kColumns], slope[kColumns], bend[kColumns];

    __attribute__((noinline)) int32_t at(float across, float up) const {
      float sum[kColumns];
      for (uint8_t i = 0; i < kColumns; ++i) sum[i] = constant[i] + up * (slope[i] + up * bend[i]);
      return int32_t(lround(sum[0] + across * (sum[1] + across * sum[2])));
    }

    /// Takes over a row of three lengths, less the length in the middle.
    void setRow(uint8_t row, const int32_t* length, int32_t middle);
    /// Turns rows into powers.
    void finish();
  };

  Square square_ = {{0, 0}, -1};
  float per_half_ = 0;  ///< [1/mm]
  Knot middle_ = {0, 0};
  Powers left_, right_;
};

inline void Tile::Powers::setRow(uint8_t row, const int32_t* length, int32_t middle) {
  const float low = float(length[0] - length[1]), high = float(length[2] - length[1]);
  // Until finish() each row is stored where a power of `up` will be.
  float* const kept = row == 0 ? constant : row == 1 ? slope : bend;
  kept[0] = float(length[1] - middle);
  kept[1] = 0.5f * (high - low);
  kept[2] = 0.5f * (high + low);
}

inline void Tile::Powers::finish() {
  for (uint8_t i = 0; i < kColumns; ++i) {
    const float low = constant[i] - slope[i], high = bend[i] - slope[i];
    constant[i] = slope[i];
    slope[i] = 0.5f * (high - low);
    bend[i] = 0.5f * (high + low);
  }
}

template <class Inverse>
bool Tile::lay(const Square& square, const Inverse& inverse) {
  forget();
  const Reached middle = knotAt(inverse, square.middle);
  if (!middle.reachable) return false;
  for (uint8_t row = 0; row < kColumns; ++row) {
    int32_t left[kColumns], right[kColumns];
    for (uint8_t column = 0; column < kColumns; ++column) {
      const Point<float> place = {square.middle.x + float(column - 1) * square.half,
                                  square.middle.y + float(row - 1) * square.half};
      const bool is_middle = row == 1 && column == 1;
      const Reached here = is_middle ? middle : knotAt(inverse, place);
      if (!here.reachable) return false;
      left[column] = here.knot.left;
      right[column] = here.knot.right;
    }
    left_.setRow(row, left, middle.knot.left);
    right_.setRow(row, right, middle.knot.right);
  }
  left_.finish();
  right_.finish();
  middle_ = middle.knot;
  per_half_ = 1 / square.half;
  square_ = square;
  return true;
}

}  // namespace motion
