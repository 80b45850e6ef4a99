// Which motor shield is plugged in.
#pragma once

#include <Arduino.h>

#include "board_pins.h"

namespace board {

/// The shield that the straps name, or null if no shield has these straps. (Without a shield the
/// board reads like v1.2.)
inline const Shield* detectShield() {
  uint8_t straps = 0;
  for (uint8_t i = 0; i < kStrapCount; ++i) {
    pinMode(kFirstStrapPin + i, INPUT_PULLUP);
    if (digitalRead(kFirstStrapPin + i) == HIGH) straps |= uint8_t(1 << i);
  }
  for (const Shield& shield : kShields)
    if (shield.straps == straps) return &shield;
  return 0;
}

}  // namespace board
