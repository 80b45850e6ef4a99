// A path that leads out of the sled's area, cut into pieces that the sled can go.
#pragma once

#include "area.h"

namespace machine {

/// The pieces of a path, in order. Each coordinate by itself is limited to the area. Inside the
/// area a piece is the path; outside it is a line along the edge to where the path comes back.
/// Where both coordinates are outside, the sled waits in a corner, and the piece has no length.
class EdgeCut {
 public:
  /// Reads path and area as long as it lives.
  EdgeCut(const motion::Path<float>& path, const Area& area);

  /// Whether any of the path is out of the area.
  bool leaves() const { return leaves_; }

  /// Takes the next piece; false after the last. Each piece begins where the last piece ended.
  bool next();
  const motion::Path<float>& piece() const { return piece_; }
  /// Share [1] of the whole path at the end of the piece.
  float share() const { return shares_[at_]; }

 private:
  enum : uint8_t { kMostCuts = 8 };  // an arc crosses each of four edges twice

  void cutLine();
  void cutArc();
  void cutAngle(float angle);
  void cutAt(float share);
  bool isInside(uint8_t index) const;

  const motion::Path<float>& path_;
  const Area& area_;
  motion::Path<float> piece_;
  motion::Point<float> here_;    ///< where the next piece begins
  float shares_[kMostCuts + 1];  ///< ends of the pieces as shares of the path; the last is 1
  uint8_t cuts_ = 0, at_ = 255;
  bool leaves_ = false;
};

}  // namespace machine
