// Turns queued moves into set-points: where all axes shall be at each control tick.
//
// How to use it (everything here runs in the main program; only SetPoints::take is for the tick):
//   mover.prepare(limits, seconds_per_tick);  mover.setSprockets(...), setArea(...);  at rest
//   mover.standAt(set_point);                 at rest, where the axes are
//   mover.add(path, z_to, feed, space);       if hasRoom(); `ok` may go out
//   mover.fill(set_points, inverse);          often: at least every 100 ms
//   mover.boost(1.5f, 20);                    multiplies feeds; then go on filling
// All moves are done when isIdle() and set_points.isEmpty(). playback.h plays the set-points, and
// may brake and hold at any moment.
#pragma once

#include "move_queue.h"
#include "segment.h"
#include "set_points.h"
#include "stretch.h"
#include "tiles.h"

namespace motion {

/// The result of filling.
enum class Filled : uint8_t {
  kYes,
  kOutOfReach,  ///< the exact inverse refused a place on the path; set-points end before it
};

/// The queue, and how far its first move has come.
class Mover {
 public:
  void prepare(const Limits& limits, float seconds_per_tick) {
    queue_.prepare(limits, seconds_per_tick);
  }
  void setSprockets(const Sprockets<float>& sprockets) { queue_.setSprockets(sprockets); }
  /// Sets the area where short moves in a row may share exact places. To be called whenever the
  /// inverse changes.
  void setArea(const SmoothArea& area) { tiles_.setArea(area); }

  /// Whether no move is in progress and none waits.
  bool isIdle() const { return queue_.isEmpty(); }
  bool hasRoom() const { return queue_.hasRoom(); }
  /// Whether all moves together last longer than `ticks`; see MoveQueue::lastsLonger.
  bool lastsLonger(uint16_t ticks) const { return queue_.lastsLonger(ticks, walk()); }

  /// Begins at a set-point, at rest; drops the moves that wait.
  void standAt(const SetPoint& point);

  /// Queues a move from the end of the last move; `z_to` [mm], `feed` [mm/s] over all axes.
  /// `beam`: strength of a laser at the move's feed; it is weaker where the move is slower.
  /// `is_rapid`: the feed is none of the program's, so boost() slows the move otherwise.
  Added add(const Path<float>& path, float z_to, float feed, Space space = Space::kSheet,
            uint8_t beam = 0, bool is_rapid = false);

  /// Fills the ring with set-points. `inverse`: Point<float> -> Lengths<float>. After a move of z
  /// alone that ends at rest nothing goes on before `is_z_near`.
  template <class Inverse>
  Filled fill(SetPoints& set_points, const Inverse& inverse, bool is_z_near = true);
  /// Whether the next set-point waits for z.
  bool awaitsZ() const { return awaits_z_; }

  /// From now on multiplies feeds; see MoveQueue::boost.
  void boost(float times, float most_feed, float rapid = 1);
  /// Drops the moves that wait: for when axes stand, motors are off, or something else moves them.
  void forget();

  /// The last set-point that was worked out: where all axes come to rest, once isIdle().
  const SetPoint& last() const { return last_; }
  /// How far the first move has come at that set-point, and its speed [mm/tick].
  Walk walk() const;
  const MoveQueue& queue() const { return queue_; }
  /// How often the ring ran dry in the middle of a move, since the last call.
  uint16_t timesDry() {
    const uint16_t times = times_dry_;
    times_dry_ = 0;
    return times;
  }

 private:
  void standStill() { segment_ = standing({last_.left, last_.right}); }
  void cutShort();
  void takeUp();
  void dropFirst();
  int32_t zAt(const Move& move, float done) const;
  template <class Inverse>
  __attribute__((noinline)) Reached lengthsAt(const Walk& walk, const Inverse& inverse);
  template <class Inverse>
  __attribute__((noinline)) Reached exactlyAt(const Walk& walk, const Inverse& inverse) const;
  template <class Inverse>
  bool begin(const Stretch& stretch, const Inverse& inverse);
  template <class Inverse>
  bool pass(const Inverse& inverse);
  /// Whether the first move is of z alone.
  bool isOfZ() const { return queue_.first().path.length == 0; }
  template <class Inverse>
  bool step(float change, const Inverse& inverse);
  // Not inline: else every tick would save the registers that only a new segment needs.
  template <class Inverse>
  __attribute__((noinline)) bool cut(const Inverse& inverse);
  void advance();
  void push(SetPoints& set_points) const;
  /// The beam at the present speed: the move's beam times speed over feed. Not inline: few moves
  /// have a beam.
  __attribute__((noinline)) uint8_t beamNow() const {
    if (way_ >= feed_way_) return beam_;
    const uint8_t weaker = uint8_t((int32_t(beam_) * way_ + feed_way_ / 2) / feed_way_);
    return weaker == 0 ? 1 : weaker;
  }

  MoveQueue queue_;
  Tiles tiles_;
  Walk walk_ = {0, 0};   ///< where the segment in progress ends
  Walk begun_ = {0, 0};  ///< where that segment began
  float change_ = 0;     ///< change of the speed in each tick of the segment
  uint8_t ticks_ = 0;    ///< of the segment
  Segment segment_;      ///< both chains
  Steps z_steps_;
  bool has_z_ = false;                 ///< the first move also moves z
  bool awaits_z_ = false;              ///< z alone has moved, and the next move waits for it
  bool is_taken_up_ = false;           ///< the two numbers below belong to the first move
  uint8_t even_ticks_, uneven_ticks_;  ///< most ticks of a segment
  float z_from_ = 0;                   ///< [mm] where the first move begins
  float z_end_ = 0;                    ///< [mm] where the last move ends
  SetPoint last_ = {0, 0, 0};
  int32_t way_ = 0;         ///< [counts] of the last tick
  int32_t way_change_ = 0;  ///< change of `way_` in each tick of the segment
  int32_t feed_way_ = 1;    ///< [counts] way of a tick at the move's feed
  uint8_t beam_ = 0;        ///< the weakest beam of the moves in this tick
  uint16_t gain_ = 1;       ///< [counts/tick] by which the way may change
  uint16_t times_dry_ = 0;
};

}  // namespace motion

#include "mover_detail.h"
