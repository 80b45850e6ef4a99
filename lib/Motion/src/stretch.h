// Speed along a move: for how many ticks it may change by the same amount.
//
// Invariants of nextStretch(), for a speed from which the exit's speed can be reached; `a` is the
// acceleration (test_invariants.cpp):
//  1. A stretch has at least a tick, and no more than its limit; of several ticks the change is 0,
//     a or -a.
//  2. A stretch of several ticks never leads beyond the move's end.
//  3. The speed is never above its top by more than 0.02 a; a higher speed only falls. It is never
//     below zero by more than 0.02 a.
//  4. It changes by at most 1.25 a in a tick, in the last ticks before an end by at most 2 a.
//  5. At the end it is at most the exit's speed and 0.55 a, or a single short tick.
#pragma once

#include <math.h>
#include <stdint.h>

namespace motion {

/// How far a move has come at a tick, and the speed of the last tick [mm/tick].
struct Walk {
  float done;  ///< [mm] of the move in progress
  float speed;
};

/// Ticks in which the speed changes evenly.
struct Stretch {
  uint8_t ticks;
  float change;  ///< [mm/tick^2] of the speed, each tick
};

/// Limits of the next stretch; speeds are in mm/tick.
struct Bounds {
  float left;          ///< [mm] that remain of the move
  float top;           ///< largest speed
  float acceleration;  ///< [mm/tick^2]
  float exit_squared;  ///< square of the largest speed at the move's end
  uint8_t even_ticks;  ///< most ticks of a stretch at constant speed
  uint8_t uneven_ticks;
};

/// A walk after some ticks of a stretch.
inline Walk after(const Walk& walk, float change, uint8_t ticks) {
  const float n = float(ticks);
  return {walk.done + n * (walk.speed + 0.5f * change * (n + 1)), walk.speed + change * n};
}

namespace stretch_detail {

inline uint8_t atMost(float ticks, uint8_t most) {
  return !(ticks < float(most)) ? most : ticks < 1 ? 1 : uint8_t(ticks);
}

/// Ticks until the speed must fall, reaches its top, or the move ends.
///
/// After n ticks the speed is w = u + n a, and the way is (w^2 - u^2) / 2a + (w - u) / 2. Braking
/// then begins in time if exit^2 + 2 a left >= (w - a/2)^2. The code solves this for w.
inline float ticksOfGain(float speed, const Bounds& bounds) {
  const float a = bounds.acceleration;
  const float behind = 2 * a * bounds.left + speed * speed + a * speed;
  const float brakes = float(sqrt(0.5f * (bounds.exit_squared + behind - 0.25f * a * a)));
  const float ends = float(sqrt(behind + 0.25f * a * a)) - 0.5f * a;
  float most = brakes < ends ? brakes : ends;
  if (bounds.top < most) most = bounds.top;
  return (most - speed) / a;
}

/// Ticks at this speed before braking must begin.
inline float ticksOfCruise(float speed, const Bounds& bounds) {
  const float a = bounds.acceleration, last = speed - 0.5f * a;
  const float brakes = (last * last - bounds.exit_squared) / (2 * a);
  return (bounds.left - (brakes > 0 ? brakes : 0)) / speed;
}

/// Ticks of braking to a top that was lowered below the sled's speed.
inline Stretch slowing(float speed, const Bounds& bounds) {
  const uint8_t ticks = atMost((speed - bounds.top) / bounds.acceleration, bounds.uneven_ticks);
  const bool fits = after({0, speed}, -bounds.acceleration, ticks).done <= bounds.left;
  return {fits ? ticks : uint8_t(1), -bounds.acceleration};
}

}  // namespace stretch_detail

/// The next ticks of a move: as fast as allowed, and slow enough to keep the speed at its end.
///
/// From the speed of the next tick it must still be possible to brake by `a` each tick down to the
/// exit's speed at the end. So that speed is at most sqrt(exit^2 + 2 a left) - a/2. From exactly
/// that speed, the next speed is lower by exactly `a`. At the exit's speed there is no need to
/// brake. A rest of the way shorter than `a` is a single tick. A stretch of a single tick may lead
/// beyond the move's end; a longer stretch never does.
inline Stretch nextStretch(float speed, const Bounds& bounds) {
  using namespace stretch_detail;
  const float a = bounds.acceleration;
  if (speed > bounds.top + a) return slowing(speed, bounds);
  const float exit = float(sqrt(bounds.exit_squared));
  const float last = bounds.left < a ? bounds.left : a;
  float may = float(sqrt(bounds.exit_squared + 2 * a * bounds.left)) - 0.5f * a;
  if (may < exit) may = exit;
  if (may < last) may = last;
  float next = speed + a;
  if (next > bounds.top) next = bounds.top;
  if (next > may) next = may;
  const float change = next - speed, kNear = 0.02f * a;
  if (change > a - kNear) return {atMost(ticksOfGain(speed, bounds), bounds.uneven_ticks), a};
  if (next == bounds.top && change == 0)
    return {atMost(ticksOfCruise(speed, bounds), bounds.even_ticks), 0};
  if (change < kNear - a && change > -kNear - a) {
    uint8_t ticks = atMost((speed - exit) / a - 0.5f, bounds.uneven_ticks);
    // A speed that is slightly too high (kNear) would lead the last of them beyond the end.
    while (ticks > 1 && after({0, speed}, -a, ticks).done > bounds.left) --ticks;
    return {ticks, -a};
  }
  return {1, change};
}

}  // namespace motion
