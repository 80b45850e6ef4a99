// Which motor shield sits on the board.
#pragma once

#include <Arduino.h>

#include "board_pins.h"

/// The shield that its straps name, or null where no shield says this (a shield without straps
/// reads like v1.2).
inline const board::Shield* detectShield() {
  uint8_t straps = 0;
  for (uint8_t i = 0; i < board::kStrapCount; ++i) {
    pinMode(board::kFirstStrapPin + i, INPUT_PULLUP);
    if (digitalRead(board::kFirstStrapPin + i) == HIGH) straps |= uint8_t(1 << i);
  }
  for (const board::Shield& shield : board::kShields)
    if (shield.straps == straps) return &shield;
  return 0;
}
