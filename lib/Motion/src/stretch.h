// How speed goes on along a move: for how many ticks it may change by the same amount.
#pragma once

#include <math.h>
#include <stdint.h>

namespace motion {

/// Where a move stands at a tick. The speed is that of the last tick [mm/tick].
struct Walk {
  float done;  ///< [mm] of the move in hand
  float speed;
};

/// Ticks in which the speed changes evenly.
struct Stretch {
  uint8_t ticks;
  float change;  ///< of the speed, each tick [mm/tick^2]
};

/// What bounds the next stretch; speeds in [mm/tick].
struct Bounds {
  float left;          ///< [mm] of the move
  float top;           ///< speed
  float acceleration;  ///< [mm/tick^2]
  float exit_squared;  ///< of the speed at the move's end, at most
  uint8_t even_ticks;  ///< of a stretch at constant speed, at most
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

/// Ticks in which the speed may still grow before it must fall again, reaches its top or the end.
///
/// After n ticks speed is w = u + n a, and (w^2 - u^2) / 2a + (w - u) / 2 is behind. Braking then
/// begins in time if exit^2 + 2 a left >= (w - a/2)^2; solved for w.
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

/// Ticks of braking to a top that was lowered while the sled was faster.
inline Stretch slowing(float speed, const Bounds& bounds) {
  const uint8_t ticks = atMost((speed - bounds.top) / bounds.acceleration, bounds.uneven_ticks);
  const bool fits = after({0, speed}, -bounds.acceleration, ticks).done <= bounds.left;
  return {fits ? ticks : uint8_t(1), -bounds.acceleration};
}

}  // namespace stretch_detail

/// The next ticks of a move: as fast as allowed, and slow enough to keep the speed at its end.
///
/// In the next tick speed may be so much that a tick later, with `left` that much less, it can fall
/// by one acceleration a tick down to the exit's: sqrt(exit^2 + 2 a left) - a/2. From a speed
/// that is just that much the next one is lower by exactly a. With the exit's speed itself
/// nothing is to be lost; the last way of less than `a` is one tick. One tick may lead beyond the
/// move's end; more never do.
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
    const uint8_t ticks = atMost((speed - exit) / a - 0.5f, bounds.uneven_ticks);
    // What was near may leave the last of them a hair beyond the end.
    const bool fits = ticks == 1 || after({0, speed}, -a, ticks).done <= bounds.left;
    return {fits ? ticks : uint8_t(ticks - 1), -a};
  }
  return {1, change};
}

}  // namespace motion
