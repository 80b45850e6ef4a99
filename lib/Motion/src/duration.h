// How long a move lasts.
#pragma once

#include <math.h>
#include <stdint.h>

namespace motion {

/// A length to travel and the limits of its speed.
struct Way {
  float length;        ///< [mm]
  float top;           ///< [mm/tick] speed, at most
  float acceleration;  ///< [mm/tick^2]
};

/// Ticks from the entry speed to the exit speed [mm/tick] over the whole length, as fast as its
/// limits allow.
///
/// The speed rises to its peak and falls again: peak^2 = acceleration * length +
/// (entry^2 + exit^2) / 2. If that exceeds the top, the sled cruises at the top in between.
inline float ticksOf(const Way& way, float entry, float exit) {
  const float squares = 0.5f * (entry * entry + exit * exit);
  const float most = way.acceleration * way.length + squares;
  const float top_squared = way.top * way.top;
  if (most <= top_squared) {
    const float peak = float(sqrt(most));
    return (2 * peak - entry - exit) / way.acceleration;
  }
  const float changing = (2 * way.top - entry - exit) / way.acceleration;
  const float changed = (top_squared - squares) / way.acceleration;
  return changing + (way.length - changed) / way.top;
}

}  // namespace motion
