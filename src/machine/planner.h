// The mover of lib/Motion behind the machine's settings, geometry and axes.
#pragma once

#include <Settings.h>

#include "axes.h"
#include "geometry.h"

namespace machine {

/// Queued moves and their set-points. Everything here runs in the main program.
class Planner {
 public:
  /// [mm/min] Largest speed of a chain's gearbox.
  static float mostChainSpeed(const settings::Values& values);

  void prepare(const settings::Values& values, float seconds_per_tick);

  /// Takes over a geometry for lib/Motion. To be called at rest, whenever it was prepared.
  void setGeometry(const Geometry& geometry);

  /// Whether no move is in progress and none is queued.
  bool isIdle() const { return moves_.isIdle(); }
  bool hasRoom() const { return moves_.hasRoom(); }
  const motion::MoveQueue& queue() const { return moves_.queue(); }
  /// Whether all moves together last longer than `ticks`, which is at most 4000.
  bool lastsLonger(uint16_t ticks) const { return moves_.lastsLonger(ticks); }

  /// Queues a move from the end of the last move; `space` is Geometry's of the path. `feed` [mm/s]
  /// is over all three axes, `beam` the strength of a laser on it; `is_rapid`: the feed is none of
  /// the program's. False if the path could not be drawn.
  bool add(const motion::Path<float>& path, float z_to, float feed, motion::Space space,
           uint8_t beam = 0, bool is_rapid = false);

  /// Queues a move of a single axis to a length [mm], at rest; `feed` [mm/s].
  void addAxis(Axis axis, float length, float feed);

  /// Gives the axes as many set-points as they have room for. False if the path comes to a place
  /// where no sled can hang.
  __attribute__((noinline)) bool fill(Axes& axes, const Geometry& geometry);

  /// Drops what is left of the path; to be called where the axes stand.
  void standHere(Axes& axes);
  void forget() { moves_.forget(); }

  /// From now on multiplies feeds by `times`, up to the greatest feed, and the speed of rapids by
  /// `rapid` [1], at most 1.
  void boost(float times, float rapid);
  /// [mm/tick] Planned speed of the tool.
  float speed() const { return isIdle() ? 0 : moves_.walk().speed; }
  /// How often set-points ran dry in the middle of a move, since the last call.
  uint16_t timesDry() { return moves_.timesDry(); }

  /// Begins at the axes' set-points, at rest.
  void standAt(const SetPoint& point) { moves_.standAt(point); }

 private:
  motion::Mover moves_;
  float boost_ = 1;          ///< [1] factor of feeds
  float rapid_ = 1;          ///< [1] factor of rapids
  float greatest_feed_ = 0;  ///< [mm/s]
};

}  // namespace machine
