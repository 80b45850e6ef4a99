// The queue of moves, and how it becomes set-points: speeds that look ahead over all queued moves,
// chain lengths between exact knots.
#pragma once

#include <Settings.h>

#include "axes.h"
#include "block.h"
#include "chain_segment.h"
#include "geometry.h"

namespace machine {

/// How it went.
enum class Moved : uint8_t {
  kYes,
  kNoPath,      ///< an arc that is none
  kOutOfReach,  ///< no sled can hang on the way
};

/// All of it runs in the main program.
class Mover {
 public:
  enum : uint8_t { kMost = 12 };

  void prepare(const settings::Values& values, float seconds_per_tick);

  /// Nothing moves, nothing is queued.
  bool isIdle() const { return count_ == 0; }
  bool hasRoom() const { return count_ < kMost; }

  /// Queues a move from where the last one ends; `feed` [mm/s] over all three axes.
  Moved add(const motion::Path<float>& path, float z_to, float feed);

  /// Gives the axes as many set-points as they have room for.
  Moved fill(Axes& axes, const Geometry& geometry);

  /// Brakes, forgets the rest.
  void stop() { braking_ = count_ != 0; }
  void forget();

  /// Everything begins here: at set-points that the axes have.
  void standAt(const SetPoint& point);

 private:
  Block& at(uint8_t index) { return ring_[uint8_t(first_ + index) % kMost]; }
  void limitEntry(Block& block);
  void lookAhead();
  float nextSpeed(const Block& block);
  void dropFirst();
  bool advance(const Geometry& geometry, SetPoint& point);
  bool placeAt(const Block& block, const Geometry& geometry, SetPoint& point);

  Block ring_[kMost];
  uint8_t first_ = 0, count_ = 0;
  MoveLimits limits_;
  float seconds_ = 0.01f;       ///< of a tick
  float done_ = 0, speed_ = 0;  ///< [mm], [mm/s] in the first block
  float z_end_ = 0;             ///< [mm] of the last move queued
  SetPoint last_ = {0, 0, 0};
  ChainSegment segment_;
  bool braking_ = false;
};

}  // namespace machine
