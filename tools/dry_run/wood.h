// The wood of a sheet as a map of heights, from which a bit takes what it meets.
#pragma once

#include <cstddef>
#include <vector>

namespace dry_run {

/// A place of the bit's tip [mm].
struct Tip {
  double x, y, z;
};

/// A bit: a cylinder, or a cone of that greatest radius.
struct Bit {
  double radius;  ///< [mm]
  double slope;   ///< rise of its edge over the distance from its axis; 0 of a flat bit
};

/// Cells with the height of the wood at the middle of each [mm]; 0 is the face of the sheet.
class Wood {
 public:
  Wood(double left, double low, size_t columns, size_t rows, double cell)
      : left_(left), low_(low), cell_(cell), columns_(columns), heights_(columns * rows, 0.0f) {}

  /// Leads the bit straight from one place to another. Returns how deep it went into wood [mm],
  /// where it met some over more than the outermost `graze` of its radius.
  double take(const Tip& from, const Tip& to, const Bit& bit, double graze);

  const std::vector<float>& heights() const { return heights_; }
  size_t columns() const { return columns_; }

 private:
  struct Span {
    size_t first, behind;
  };
  Span cells(double low, double high, double begin, size_t count) const;

  double left_, low_, cell_;
  size_t columns_;
  std::vector<float> heights_;  ///< row by row, the lowest first
};

}  // namespace dry_run
