// Quadrature decoding: which way an encoder turned, from its two channels before and after. Without
// Arduino.
#pragma once

#include <stdint.h>

#include "drivers.h"

namespace board {

/// Pairs of pins with interrupts: 21 and 20, 19 and 18, 2 and 3; the lower bit of the port first.
enum : uint8_t { kEncoderPairs = 3 };

/// The pair of pins that an encoder is on, and whether its count runs against the pair's.
struct EncoderWiring {
  uint8_t pair;
  bool reversed;
};

/// Count that a change of state (high channel, low channel) adds. The count rises when the
/// high channel leads: 0, 2, 3, 1. If both channels changed, the direction is unknown.
const int8_t kQuadratureSteps[16] = {0, -1, +1, 0, +1, 0, 0, -1, -1, 0, 0, +1, 0, +1, -1, 0};

/// A pair of channels, its count, and how often an edge was missed.
struct Quadrature {
  uint8_t state;
  uint16_t count;    ///< wraps round
  uint16_t illegal;  ///< steps in which both channels changed; wraps round

  /// Takes the channels' new levels, high channel in bit 1.
  __attribute__((always_inline)) void turn(uint8_t bits) {
    if ((state ^ bits) == 3) ++illegal;
    count = uint16_t(count + kQuadratureSteps[uint8_t(state << 2) | bits]);
    state = bits;
  }
};

/// Where a motor's encoder is counted. Its two channels change places with the feed, as the
/// driver's pins do. The count rises when the second channel leads.
inline EncoderWiring encoderOf(const Shield& shield, Motor motor, bool over_top) {
  const MotorPins& pins = pinsOf(shield, motor);
  const bool cross = motor == Motor::kZ || isCrossed(motor, over_top);
  const uint8_t first = cross ? pins.encoder_b : pins.encoder_a;
  const uint8_t pair = first >= 20 ? 0 : first >= 18 ? 1 : 2;
  return {pair, first == 20 || first == 18 || first == 3};
}

}  // namespace board
