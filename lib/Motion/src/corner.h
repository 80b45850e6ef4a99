// How fast the sled may pass a corner between two moves without a stop.
#pragma once

#include <math.h>

#include "path.h"

namespace motion {

/// A direction over all three axes, of length 1.
struct Direction {
  float x, y, z;
};

const float kAnySpeedSquared = 1e9f;  // [mm^2/tick^2] no limit

/// Direction of a path along the sheet where it begins, or where it ends [1].
inline Point<float> directionOf(const Path<float>& path, bool at_end) {
  if (path.drawn != Drawn::kYes) return {0, 0};
  if (path.sweep == 0)
    return {(path.to.x - path.from.x) / path.length, (path.to.y - path.from.y) / path.length};
  const Point<float>& at = at_end ? path.to : path.from;
  // Around the centre, and away from it as the radius grows.
  const float x = at.x - path.centre.x, y = at.y - path.centre.y;
  const float radius_squared = x * x + y * y, sweep = path.sweep;
  const float per = 1 / float(sqrt(sweep * sweep * radius_squared + path.grows * path.grows));
  const float round = sweep * per, out = path.grows * per / float(sqrt(radius_squared));
  return {x * out - y * round, y * out + x * round};
}

/// Square of the speed at which the sled may pass a corner, in [mm] and the time of `acceleration`.
///
/// The smaller of two limits, with t the turn:
///  1. Junction deviation, as in Grbl: the sled cuts the corner by an arc that touches both sides
///     and stays within `deviation` of the corner: v^2 = acceleration * deviation * cos(t/2) /
///     (1 - cos(t/2)).
///  2. Between short moves that arc would be longer than the moves. So the turn is spread over
///     `room`, half of both moves together: v^2 = acceleration * (room + deviation) / t. A curve
///     made of short moves is then as fast as an arc of its radius.
inline float cornerSpeedSquared(const Direction& before, const Direction& after, float acceleration,
                                float deviation, float room) {
  const float x = after.x - before.x, y = after.y - before.y, z = after.z - before.z;
  // The turn follows from the difference of the directions: in float, 1 - cos of a small turn is
  // noise.
  const float turn_squared = x * x + y * y + z * z;
  const float kNoTurn = 1e-8f;  // [rad^2]
  if (turn_squared < kNoTurn) return kAnySpeedSquared;
  const float half_squared = turn_squared * 0.25f;
  const float cosine = half_squared < 1 ? float(sqrt(1 - half_squared)) : 0;
  const float by_deviation = deviation * cosine * (1 + cosine) / half_squared;
  const float by_room = (room + deviation) / float(sqrt(turn_squared));
  return acceleration * (deviation == 0 || by_deviation < by_room ? by_deviation : by_room);
}

}  // namespace motion
