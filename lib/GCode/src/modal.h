// Modes that stay in force from line to line, and how they change numbers.
#pragma once

#include <stdint.h>

namespace gcode {

const float kMmPerInch = 25.4f;

/// Modes of motion by their G number; G0 to G3 are the numbers 0 to 3.
enum : uint8_t { kNoMotion = 80, kDrill = 81, kDrillAndDwell = 82, kPeck = 83 };

/// How the next line is to be read. Survives stops and soft resets.
struct Modal {
  bool inches = false, relative = false;
  bool absolute_centres = false;     ///< G90.1: I and J count as X and Y do
  bool inverse_time = false;         ///< G93: F is 1 / the move's time [1/min]
  bool retracts_to_r = false;        ///< G99; G98 returns to where z was
  bool machine_coordinates = false;  ///< G53, in this line
  uint8_t plane = 17;                ///< 17 to 19 for G17 to G19
  uint8_t system = 0;                ///< 0 to 5 for the coordinates of G54 to G59
  uint8_t motion = 0;                ///< 0 to 3 as G0 to G3, kNoMotion or a drilling cycle
  float feed = 0;                    ///< [mm/min]
  float inverse_feed = 0;            ///< [1/min] of this line, with G93; 0: it has no F
  uint16_t tool = 0;                 ///< as the last T said
  uint16_t tool_in_spindle = 0;

  /// A length or feed of a line in mm or mm/min.
  float toMm(float value) const { return inches ? value * kMmPerInch : value; }
  /// A length or feed in the units of the line.
  float fromMm(float mm) const { return inches ? mm / kMmPerInch : mm; }
  /// The machine coordinate [mm] for a number in a line. The axis stands at `from` [mm] and the
  /// program's coordinates begin at `offset` [mm].
  float targetOf(float from, float value, float offset) const {
    if (machine_coordinates) return toMm(value);
    return relative ? from + toMm(value) : offset + toMm(value);
  }

  /// Ends what applies to a single line only.
  void beginLine();
  /// M2 and M30: coordinates of G54, the plane of G17, feed a minute, and no cycle.
  void endProgram();

  /// Takes a code that only changes how words are read, or confirms what is always so; `tenths` is
  /// ten times the code. False for any other code.
  bool take(uint16_t tenths);
};

}  // namespace gcode
