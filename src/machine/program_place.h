// Where the program is: where its queued moves end, and where it counts from.
#pragma once

#include <Motion.h>

namespace machine {

/// Where the tool is [mm].
struct Place {
  float x, y, z;
};

/// Two places of the program. The aim is where its last queued move ends. The place that it counts
/// from is where its last line ends on paper. They differ only where the path is beyond the sheet,
/// because the sled keeps to the edge.
///
/// Where the sled truly is belongs to SledPlace, which sets both places after each search. Moves
/// alone takes them on, move by move.
class ProgramPlace {
 public:
  const Place& aim() const { return aim_; }
  Place counted() const { return {counted_.x, counted_.y, aim_.z}; }
  /// Whether the program's place is not the sled's: it is beyond the sheet's edge.
  bool isCountedBeyond() const { return counted_.x != aim_.x || counted_.y != aim_.y; }

  /// For SledPlace: nothing is queued, and all moves begin here.
  void beginAt(const Place& place) {
    aim_ = place;
    countFromAim();
  }

  /// For Moves: the last piece in the queue ends here.
  void endAt(const Place& end) { aim_ = end; }
  /// The tool is at this z [mm], or the last piece in the queue moves z alone, to there.
  void endAtZ(float z) { aim_.z = z; }
  /// For Moves: the line ends here [mm], whether or not the sled goes so far.
  void countFrom(float x, float y) { counted_ = {x, y}; }
  /// A jog begins: the program counts from where the sled will be.
  void countFromAim() { counted_ = {aim_.x, aim_.y}; }

 private:
  Place aim_ = {0, 0, 0};
  motion::Point<float> counted_ = {0, 0};  ///< [mm]
};

}  // namespace machine
