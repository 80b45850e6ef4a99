// A cell is cut if the bit covers its middle, so cutting the same path again changes nothing.
#include "wood.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dry_run {
namespace {

/// A straight way, seen from above.
struct Way {
  Way(const Tip& from, const Tip& to)
      : from(from), length(std::hypot(to.x - from.x, to.y - from.y)), rise(to.z - from.z) {
    if (length > 0) x = (to.x - from.x) / length, y = (to.y - from.y) / length;
  }

  double z(double along) const {
    return from.z + (length > 0 ? rise * along / length : std::min(rise, 0.0));
  }

  /// The lowest height of the bit's edge over a place; infinite where the bit does not come.
  double edge(double place_x, double place_y, double radius, double slope) const {
    const double east = place_x - from.x, north = place_y - from.y;
    const double along = east * x + north * y;
    const double across2 = east * east + north * north - along * along;
    const double half2 = radius * radius - across2;
    if (half2 < 0) return INFINITY;
    const double half = std::sqrt(half2);
    const double first = std::max(0.0, along - half), last = std::min(length, along + half);
    if (first > last) return INFINITY;
    if (slope == 0) return std::min(z(first), z(last));
    const double nearest = std::clamp(along, 0.0, length);
    return z(nearest) + slope * std::sqrt(across2 + (along - nearest) * (along - nearest));
  }

  /// The least and the greatest x of that part of the way that passes a row no farther than that.
  std::pair<double, double> besides(double row_y, double far) const {
    double first = 0, last = length;
    if (y != 0) {
      const double below = (row_y - far - from.y) / y, above = (row_y + far - from.y) / y;
      first = std::clamp(std::min(below, above), 0.0, length);
      last = std::clamp(std::max(below, above), 0.0, length);
    }
    return std::minmax({from.x + first * x, from.x + last * x});
  }

  Tip from;
  double length, rise;
  double x = 0, y = 0;  ///< direction
};

}  // namespace

Wood::Span Wood::cells(double low, double high, double begin, size_t count) const {
  const double first = std::ceil((low - begin) / cell_ - 0.5);
  const double last = std::floor((high - begin) / cell_ - 0.5);
  if (last < 0 || last < first) return {0, 0};
  return {size_t(std::max(first, 0.0)), std::min(count, size_t(last) + 1)};
}

double Wood::take(const Tip& from, const Tip& to, const Bit& bit, double graze) {
  if (std::min(from.z, to.z) >= 0) return 0;
  const Way way(from, to);
  const double radius = bit.radius, inner = radius * (1 - graze);
  const Span upwards = cells(std::min(from.y, to.y) - radius, std::max(from.y, to.y) + radius, low_,
                             heights_.size() / columns_);
  double deepest = 0;
  for (size_t row = upwards.first; row < upwards.behind; ++row) {
    const double y = low_ + (double(row) + 0.5) * cell_;
    const auto [west, east] = way.besides(y, radius);
    const Span across = cells(west - radius, east + radius, left_, columns_);
    for (size_t column = across.first; column < across.behind; ++column) {
      const double x = left_ + (double(column) + 0.5) * cell_;
      float& height = heights_[row * columns_ + column];
      const double edge = way.edge(x, y, radius, bit.slope);
      if (edge >= height) continue;
      const double met = way.edge(x, y, inner, bit.slope);
      if (met < height) deepest = std::max(deepest, height - met);
      height = float(edge);
    }
  }
  return deepest;
}

}  // namespace dry_run
