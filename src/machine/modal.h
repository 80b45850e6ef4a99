// What stays in force from line to line.
#pragma once

#include <stdint.h>

namespace machine {

/// How the next line is to be read. Survives stops and soft resets.
struct Modal {
  bool inches = false, relative = false;
  uint8_t motion = 0;  ///< 0 to 3, as G0 to G3
  float feed = 0;      ///< [mm/min]
  uint16_t tool = 0;   ///< as the last T said
  uint16_t tool_in_spindle = 0;
};

}  // namespace machine
