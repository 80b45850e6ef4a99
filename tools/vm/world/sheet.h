// The sheet under the bit, and the cuts in it.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

namespace world {

/// A place where the bit was below the sheet's face.
struct Cut {
  int plunge;                   ///< counts from 1 each time the bit goes in
  double seconds, x, y, depth;  ///< [s] since the world began; [mm]; [mm] below the face
};

/// Stores what the bit cuts.
class Sheet {
 public:
  /// Moves the bit to a place, with its tip `height` [mm] above the sheet's face.
  void touch(double seconds, const Eigen::Vector2d& place, double height) {
    const double kScratch = 0.05;  // [mm] too shallow to find with a tape
    if (height > -kScratch) {
      is_in_ = false;
      return;
    }
    if (!is_in_) ++plunges_;
    if (!is_in_ || isNews(place, -height))
      cuts_.push_back({plunges_, seconds, place.x(), place.y(), -height});
    is_in_ = true;
  }

  const std::vector<Cut>& cuts() const { return cuts_; }

  /// Puts a new sheet on the frame.
  void replace() {
    cuts_.clear();
    plunges_ = 0;
    is_in_ = false;
  }

 private:
  bool isNews(const Eigen::Vector2d& place, double depth) const {
    const double kSame = 0.02;  // [mm]
    const Cut& last = cuts_.back();
    return depth > last.depth + kSame || std::hypot(place.x() - last.x, place.y() - last.y) > kSame;
  }

  std::vector<Cut> cuts_;
  int plunges_ = 0;
  bool is_in_ = false;
};

}  // namespace world
