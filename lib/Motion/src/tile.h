// A small square of the sheet in which nine exact places tell the chains' lengths at all others.
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

// What a tile may miss. With what rounding adds, its lengths stay within 0.0015 mm.
const float kMostMissedInTile = 0.0005f;  // [mm]
const float kLargestHalfTile = 15;        // [mm]

/// Half the side [mm] of a tile near places that are `nearest` [mm] from a sprocket.
///
/// Nine places make a quadratic of x whose three values are quadratics of y. Along y it misses what
/// a quadratic misses over one side; along x the same, times 1.25, as three numbers that may all be
/// wrong are weighed by up to so much: together 2.25 times third slope * side^3 / 124.7.
inline float halfTile(float nearest, const Slopes<float>& effects) {
  // Its far corner is up to 0.8 + sqrt 2 halves away from the place, which it begins behind.
  const float clear = nearest - 2.3f * kLargestHalfTile;
  const float third = thirdSlope(0.0f, Surroundings<float>{clear > 1 ? clear : 1, effects});
  const float half = 0.5f * float(cbrt(kMostMissedInTile * 124.7077f / 2.25f / third));
  return half < kLargestHalfTile ? half : kLargestHalfTile;
}

/// Lengths by two quadratics, one for each chain: what is more than in the middle, in counts.
class Tile {
 public:
  /// Whether a place is in it; a tile that was never laid, or not done, holds none.
  bool holds(Point<float> place) const { return motion::holds(square_, place); }

  void forget() { square_.half = -1; }

  /// Asks the exact inverse at nine places of the square; false, and no tile, if one is refused.
  template <class Inverse>
  __attribute__((noinline)) bool lay(const Square& square, const Inverse& inverse);

  /// Both lengths at a place that it holds.
  Knot at(Point<float> place) const {
    const float across = (place.x - square_.middle.x) * per_half_;
    const float up = (place.y - square_.middle.y) * per_half_;
    return {middle_.left + left_.at(across, up), middle_.right + right_.at(across, up)};
  }

 private:
  enum : uint8_t { kColumns = 3 };

  /// What one chain has more than in the middle: powers of `across`, each a quadratic of `up`.
  struct Powers {
    float constant[kColumns], slope[kColumns], bend[kColumns];

    __attribute__((noinline)) int32_t at(float across, float up) const {
      float sum[kColumns];
      for (uint8_t i = 0; i < kColumns; ++i) sum[i] = constant[i] + up * (slope[i] + up * bend[i]);
      return int32_t(lround(sum[0] + across * (sum[1] + across * sum[2])));
    }

    /// Takes over one row of three lengths, less the middle's.
    void setRow(uint8_t row, const int32_t* length, int32_t middle);
    /// Rows become powers.
    void finish();
  };

  Square square_ = {{0, 0}, -1};
  float per_half_ = 0;  ///< [1/mm]
  Knot middle_ = {0, 0};
  Powers left_, right_;
};

inline void Tile::Powers::setRow(uint8_t row, const int32_t* length, int32_t middle) {
  const float low = float(length[0] - length[1]), high = float(length[2] - length[1]);
  // Until finish() each row stands where one power of `up` will.
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
