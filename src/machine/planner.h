// The mover of lib/Motion behind the machine's settings, geometry and axes.
#pragma once

#include <Settings.h>

#include "axes.h"
#include "geometry.h"

namespace machine {

/// Queued moves and the set-points they become. All of it runs in the main program.
class Planner {
 public:
  /// [mm/min] that the gearbox of a chain does at most.
  static float mostChainSpeed(const settings::Values& values);

  void prepare(const settings::Values& values, float seconds_per_tick);

  /// Takes over what the laws of motion must know of a geometry; at rest, whenever it was prepared.
  void setGeometry(const Geometry& geometry);

  /// Nothing moves, nothing is queued.
  bool isIdle() const { return moves_.isIdle(); }
  bool hasRoom() const { return moves_.hasRoom(); }
  /// Whether what waits lasts for more than so many ticks, which are at most 4000.
  bool lastsLonger(uint16_t ticks) const { return moves_.lastsLonger(ticks); }

  /// Queues a move over the sheet from where the last one ends; `feed` [mm/s] over all three axes,
  /// `beam`: strength of a laser on it. False if the path is none.
  bool add(const motion::Path<float>& path, float z_to, float feed, const Geometry& geometry,
           uint8_t beam = 0);

  /// Queues a move of one axis alone to a length [mm], at rest; `feed` [mm/s].
  void addAxis(Axis axis, float length, float feed);

  /// Gives the axes as many set-points as they have room for; false where no sled can hang on the
  /// way.
  bool fill(Axes& axes, const Geometry& geometry);

  /// Brakes along the way; fill() forgets the rest where the axes then stand.
  void stop(Axes& axes);
  void forget() { moves_.forget(); }

  /// From now on feeds count so many times, up to the greatest feed.
  void boost(float times);
  /// How often the axes found no set-point in the middle of a move, since this was last asked.
  uint16_t timesDry() { return moves_.timesDry(); }

  /// Everything begins here: at set-points that the axes have.
  void standAt(const SetPoint& point) { moves_.standAt(point); }

 private:
  motion::Mover moves_;
  float boost_ = 1;          ///< [1] times that feeds count
  float greatest_feed_ = 0;  ///< [mm/s]
  bool is_stopping_ = false;
};

}  // namespace machine
