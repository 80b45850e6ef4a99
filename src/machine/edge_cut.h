// A path that leads out of the sled's area, cut into what can be gone.
#pragma once

#include "area.h"

namespace machine {

/// The pieces of a path, in order, where each coordinate is brought back to the area by itself: the
/// path as long as it is in the area, else a line along the edge to where it comes back. Where both
/// coordinates are out the sled waits in a corner, and the piece has no length.
class EdgeCut {
 public:
  EdgeCut(const motion::Path<float>& path, const Area& area);

  /// Whether some of the path is out of the area.
  bool leaves() const { return leaves_; }

  /// The next piece; false after the last. Each begins where the one before ends.
  bool next();
  const motion::Path<float>& piece() const { return piece_; }
  /// How much of the whole path is behind when the piece is [1].
  float share() const { return shares_[at_]; }

 private:
  enum : uint8_t { kMostCuts = 8 };  // an arc crosses each of four edges twice

  void cutLine();
  void cutArc();
  void cutAngle(float angle);
  void cutAt(float share);
  bool isInside(uint8_t index) const;

  const motion::Path<float> path_;
  const Area area_;
  motion::Path<float> piece_;
  motion::Point<float> here_;    ///< where the next piece begins
  float shares_[kMostCuts + 1];  ///< ends of the pieces, the last is 1
  uint8_t cuts_ = 0, at_ = 255;
  bool leaves_ = false;
};

}  // namespace machine
