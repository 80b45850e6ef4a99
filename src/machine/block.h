// One move in the queue: where it leads, how fast it may go, and how fast it begins.
#pragma once

#include <Motion.h>

namespace machine {

/// Limits of all moves, worked out from the settings.
struct MoveLimits {
  float gain_xy, gain_z;    ///< [mm/s^2]
  float speed_xy, speed_z;  ///< [mm/s]
  float corner_deviation;   ///< [mm]
};

/// A line or an arc over the sheet, with z along; z alone has no path.
struct Block {
  motion::Path<float> path;
  float z_from, z_to;   ///< [mm]
  float length;         ///< [mm] over all three axes
  float gain;           ///< [mm/s^2] along it
  float top_squared;    ///< [mm^2/s^2] speed asked for, within all limits
  float entry_squared;  ///< the same, with which it begins
  float entry_limit;    ///< what the corner before it allows
  float dx, dy, dz;     ///< direction at its end [1]
};

/// Direction of a path at its beginning or end, along the sheet [1].
inline motion::Point<float> directionOf(const motion::Path<float>& path, bool at_end) {
  if (path.drawn != motion::Drawn::kYes) return {0, 0};
  if (path.sweep == 0) {
    return {(path.to.x - path.from.x) / path.length, (path.to.y - path.from.y) / path.length};
  }
  const motion::Point<float>& at = at_end ? path.to : path.from;
  const float turn = path.sweep > 0 ? 1.0f : -1.0f;
  const float x = at.x - path.centre.x, y = at.y - path.centre.y;
  const float radius = float(sqrt(x * x + y * y));
  return {-turn * y / radius, turn * x / radius};
}

/// Square of the speed [mm^2/s^2] at which a corner may be passed so that the path with bounded
/// acceleration stays within `deviation` of it. The sled is taken to follow an arc that touches
/// both sides; half the angle between them says how wide that is.
inline float cornerSpeedSquared(float cosine_of_turn, float gain, float deviation) {
  // Turned by `t`: sin of half the inner angle is cos(t / 2).
  const float half = float(sqrt((1 + cosine_of_turn) * 0.5f));
  if (half > 0.9999f) return 1e9f;
  if (cosine_of_turn < -0.999f) return 0;
  return gain * deviation * half / (1 - half);
}

}  // namespace machine
