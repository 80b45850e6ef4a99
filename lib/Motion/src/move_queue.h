// The queue of moves, and the look-ahead that sets their speeds.
#pragma once

#include "corner.h"
#include "duration.h"
#include "sprockets.h"
#include "stretch.h"

namespace motion {

/// Limits of every move.
struct Limits {
  float acceleration_xy, acceleration_z;  ///< [mm/s^2]
  float chain_speed, z_speed;             ///< [mm/s]
  float corner_deviation;                 ///< [mm]; zero: every corner is a stop
};

/// The space in which a path runs.
enum class Space : uint8_t {
  kSheet,   ///< places on the sheet; the exact inverse is smooth along it
  kEdge,    ///< places beyond the sheet's edge, where the effects' slopes are not known
  kChains,  ///< chain lengths: x is the left chain, y the right chain
};

/// The result of adding a move.
enum class Added : uint8_t {
  kYes,
  kNothing,  ///< it ends where it begins
  kFull,     ///< the queue has no room now
  kNoPath,   ///< the path could not be drawn
  kNoFeed,   ///< the feed is zero, negative, NaN or far too small
};

/// A move in the queue. Speeds are in mm/tick, accelerations in mm/tick^2.
struct Move {
  Path<float> path;      ///< if it is not drawn, z moves alone
  float z_to;            ///< [mm]
  float length;          ///< [mm] over all axes
  float acceleration;    ///< largest, along the path
  float feed;            ///< speed along the path, as commanded
  float top;             ///< largest speed along the path
  float entry_squared;   ///< square of the largest speed at its start
  float corner_squared;  ///< the same, as the corner before it allows
  uint16_t most_ticks;   ///< how long it lasts at most: from rest to rest
  Space space;
  uint8_t beam;   ///< strength of a laser along it, at its feed
  bool is_rapid;  ///< its feed is none of the program's
};

/// The moves that wait; the first is the move in progress.
class MoveQueue {
 public:
  enum : uint8_t { kMost = 16 };
  enum : uint16_t { kMostTold = 4000 };  // [ticks]

  /// Takes over limits, for ticks of `seconds_per_tick` [s].
  void prepare(const Limits& limits, float seconds_per_tick);
  void setSprockets(const Sprockets<float>& sprockets) { sprockets_ = sprockets; }

  bool isEmpty() const { return count_ == 0; }
  bool hasRoom() const { return count_ < kMost; }
  uint8_t count() const { return count_; }
  const Move& first() const { return ring_[first_]; }
  const Move& second() const { return at(1); }
  const Move& at(uint8_t index) const { return ring_[uint8_t(first_ + index) % kMost]; }
  const Sprockets<float>& sprockets() const { return sprockets_; }

  /// Square of the largest speed at the end of the first move.
  float exitSquared() const { return count_ > 1 ? at(1).entry_squared : 0; }

  /// Whether all moves together last longer than `ticks` (at most kMostTold). `walk` is how far the
  /// first move has come. This is quick where the moves would be too short even with a stop after
  /// each.
  bool lastsLonger(uint16_t ticks, const Walk& walk) const;

  /// Queues a move from the end of the last move, at z `z_from` [mm]; `feed` [mm/s] is over all
  /// axes.
  Added add(const Path<float>& path, float z_from, float z_to, float feed, Space space,
            uint8_t beam = 0, bool is_rapid = false);

  /// From now on multiplies feeds by `times`, up to `most_feed` [mm/s], and the speed of rapids by
  /// `rapid` [1], at most 1. The limits of chains, z, corners and arcs stay.
  void boost(float times, float most_feed, float rapid = 1);

  void dropFirst();
  void clear() { count_ = 0; }

 private:
  Move& at(uint8_t index) { return ring_[uint8_t(first_ + index) % kMost]; }
  float topOf(const Move& move) const;
  void plan(Move& move) const;
  void lookAhead();

  Move ring_[kMost];
  uint8_t first_ = 0, count_ = 0;
  Direction end_;                    ///< direction at the end of the last move
  Limits limits_;                    ///< per tick
  float seconds_;                    ///< that a tick lasts
  float boost_ = 1, most_feed_ = 0;  ///< the factor of feeds; their limit [mm/tick]
  float rapid_ = 1;                  ///< the factor of rapids
  Sprockets<float> sprockets_;
};

namespace queue_detail {

inline float smaller(float a, float b) { return a < b ? a : b; }

}  // namespace queue_detail

inline void MoveQueue::prepare(const Limits& limits, float seconds_per_tick) {
  const float squared = seconds_per_tick * seconds_per_tick;
  seconds_ = seconds_per_tick;
  limits_ = {limits.acceleration_xy * squared, limits.acceleration_z * squared,
             limits.chain_speed * seconds_per_tick, limits.z_speed * seconds_per_tick,
             limits.corner_deviation};
}

/// Largest speed of a move.
inline float MoveQueue::topOf(const Move& move) const {
  using queue_detail::smaller;
  float top = move.is_rapid ? move.feed * rapid_ : move.feed;
  if (!move.is_rapid && boost_ != 1 && top < most_feed_) top = smaller(top * boost_, most_feed_);
  const float along = move.path.length / move.length;
  if (along < 1) top = smaller(top, limits_.z_speed / float(sqrt(1 - along * along)));
  if (along == 0) return top;
  const float chains_top = limits_.chain_speed / along;
  if (move.space == Space::kChains) return smaller(top, chains_top);
  // Effects alone can make a chain faster than the sled, so most moves need no closer look.
  if (top * (1 + sprockets_.effects.first) > chains_top)
    top = smaller(top, chains_top / steepest(move.path, sprockets_));
  if (move.path.sweep == 0) return top;
  // Along an arc the sled accelerates towards the centre all the way.
  const float round = float(sqrt(limits_.acceleration_xy * move.path.radius)) / along;
  return smaller(top, round);
}

/// Works out what follows from a move's feed.
inline void MoveQueue::plan(Move& move) const {
  move.top = topOf(move);
  const float ticks = ticksOf({move.length, move.top, move.acceleration}, 0, 0);
  move.most_ticks = ticks < float(kMostTold) ? uint16_t(ticks) + 1 : uint16_t(kMostTold);
}

inline void MoveQueue::boost(float times, float most_feed, float rapid) {
  boost_ = times;
  rapid_ = rapid;
  most_feed_ = most_feed * seconds_;
  for (uint8_t i = 0; i < count_; ++i) {
    plan(at(i));
    if (i != 0) at(i).entry_squared = -1;
  }
  lookAhead();
}

inline Added MoveQueue::add(const Path<float>& path, float z_from, float z_to, float feed,
                            Space space, uint8_t beam, bool is_rapid) {
  using queue_detail::smaller;
  const bool has_path = path.drawn == Drawn::kYes;
  const float rise = z_to - z_from;
  if (!has_path && path.drawn != Drawn::kNoLength) return Added::kNoPath;
  if (!has_path && rise == 0) return Added::kNothing;
  if (!isfinite(rise)) return Added::kNoPath;
  const float kLeastSpeed = 1e-5f;  // [mm/tick] a float sum of a long way hardly grows by less
  if (!(feed * seconds_ > kLeastSpeed)) return Added::kNoFeed;
  if (!hasRoom()) return Added::kFull;
  Move& move = at(count_);
  move.path = path;
  if (!has_path) move.path.length = 0;
  move.z_to = z_to;
  move.space = space;
  move.beam = beam;
  move.is_rapid = is_rapid;
  const float along = move.path.length;
  move.length = rise == 0 ? along : float(sqrt(along * along + rise * rise));
  const float xy = rise == 0 ? 1 : along / move.length;
  const float z = rise == 0 ? 0 : rise / move.length;
  move.acceleration = xy > 0 ? limits_.acceleration_xy : limits_.acceleration_z;
  if (xy > 0 && z != 0) {
    move.acceleration =
        smaller(limits_.acceleration_xy / xy, limits_.acceleration_z / float(fabs(z)));
  }
  move.feed = feed * seconds_;
  plan(move);
  const Point<float> begin = directionOf(path, false);
  const Point<float> end = path.sweep == 0 ? begin : directionOf(path, true);
  move.entry_squared = move.corner_squared = 0;
  if (count_ != 0) {
    const Move& before = at(uint8_t(count_ - 1));
    // Between z alone and a path there is a stop: see Mover::fill.
    if (has_path == (before.path.length != 0))
      move.corner_squared = cornerSpeedSquared(
          end_, {begin.x * xy, begin.y * xy, z}, smaller(before.acceleration, move.acceleration),
          limits_.corner_deviation, 0.5f * (before.length + move.length));
  }
  end_ = {end.x * xy, end.y * xy, z};
  ++count_;
  lookAhead();
  return Added::kYes;
}

inline void MoveQueue::lookAhead() {
  using queue_detail::smaller;
  // Backwards from a stop at the end. Where a move's entry speed stays, all moves before it stay
  // too.
  float exit_squared = 0;
  for (uint8_t i = count_; i-- > 1;) {
    Move& move = at(i);
    const float brakes = exit_squared + 2 * move.acceleration * move.length;
    const float entry = smaller(smaller(move.corner_squared, move.top * move.top), brakes);
    if (entry == move.entry_squared && uint8_t(i + 1) != count_) return;
    move.entry_squared = entry;
    exit_squared = entry;
  }
}

inline bool MoveQueue::lastsLonger(uint16_t ticks, const Walk& walk) const {
  using queue_detail::smaller;
  uint16_t most = 0;
  for (uint8_t i = 0; i < count_; ++i) most = uint16_t(most + at(i).most_ticks);
  if (most <= ticks) return false;
  const float limit = float(ticks);
  float sum = 0, entry = smaller(walk.speed, first().top), walked = walk.done;
  for (uint8_t i = 0; i < count_; ++i) {
    const Move& move = at(i);
    const bool is_last = i + 1 == count_;
    const float next = is_last ? 0 : float(sqrt(at(uint8_t(i + 1)).entry_squared));
    const float exit = smaller(next, move.top);
    sum += ticksOf({move.length - walked, move.top, move.acceleration}, entry, exit);
    if (sum > limit) return true;
    entry = exit;
    walked = 0;
  }
  return false;
}

inline void MoveQueue::dropFirst() {
  first_ = uint8_t(first_ + 1) % kMost;
  --count_;
}

}  // namespace motion
