// What stays in force from line to line, and what follows from it for numbers.
#pragma once

#include <stdint.h>

namespace gcode {

const float kMmPerInch = 25.4f;

/// How the next line is to be read. Survives stops and soft resets.
struct Modal {
  bool inches = false, relative = false;
  uint8_t motion = 0;  ///< 0 to 3, as G0 to G3
  float feed = 0;      ///< [mm/min]
  uint16_t tool = 0;   ///< as the last T said
  uint16_t tool_in_spindle = 0;

  /// A length or feed of a line in mm or mm/min.
  float toMm(float value) const { return inches ? value * kMmPerInch : value; }
  /// The same the other way round.
  float fromMm(float mm) const { return inches ? mm / kMmPerInch : mm; }
  /// A coordinate [mm] by its number in a line, for an axis that stands at `from` [mm].
  float targetOf(float from, float value) const {
    return relative ? from + toMm(value) : toMm(value);
  }

  /// Takes G20, G21, G90 and G91, told by their tenths; false if it is another code.
  bool take(uint16_t tenths) {
    if (tenths == 200 || tenths == 210)
      inches = tenths == 200;
    else if (tenths == 900 || tenths == 910)
      relative = tenths == 910;
    else
      return false;
    return true;
  }
};

}  // namespace gcode
