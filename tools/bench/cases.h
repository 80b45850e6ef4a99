// The cases to time, a line each; the board's program and the simulator's program read them.
#pragma once

#include <stdint.h>

namespace bench {

enum What : uint8_t {
  kNothing,
  kInverse,
  kForward,
  kForwardNear,
  // Of a sled with two brackets, without a guess, and from the tilt 0.15 mm before.
  kTiltedInverse,
  kTiltedInverseNear
};

// Which effects are present, by the number of their first setting.
enum Present : uint8_t { kNone, kSagStretchPitch, kAll };

// The machine: as published, or with a sled of 60 N that needs deep sag.
enum Rig : uint8_t { kUsual, kLightSled };

struct Case {
  const char* name;
  What what;
  Present present;
  Rig rig;
  uint8_t extra;  // the first setting of an additional effect, or 0
};

const Case kCases[] = {
    {"(marks alone)", kNothing, kNone, kUsual, 0},
    {"inverse, rigid", kInverse, kNone, kUsual, 0},
    {"inverse, sag, stretch and pitch", kInverse, kSagStretchPitch, kUsual, 0},
    {"inverse, sag, stretch and pitch, light sled", kInverse, kSagStretchPitch, kLightSled, 0},
// board.py adds "inverse, the same and EFFECT" for every other effect of the registry.
#include "effect_cases.h"
    {"inverse, all effects", kInverse, kAll, kUsual, 0},
    {"forward, no guess", kForward, kSagStretchPitch, kUsual, 0},
    {"forward, guess 0.1 mm off (tracking)", kForwardNear, kSagStretchPitch, kUsual, 0},
    {"inverse, two brackets, no guess", kTiltedInverse, kNone, kUsual, 0},
    {"inverse, two brackets, tilt of 0.15 mm before", kTiltedInverseNear, kNone, kUsual, 0},
};

// Every second place of the published measurements' grid, borders included. All places would take
// four times as long; they change no median by 0.1 % and no extreme by 2 %.
enum : uint8_t {
  kCaseCount = sizeof kCases / sizeof kCases[0],
  kColumns = 25,
  kRows = 13,
  kFinished = 255,
};

inline bool isPresent(const Case& wanted, int first_setting) {
  if (wanted.extra != 0 && first_setting == wanted.extra) return true;
  const bool is_usual = first_setting >= 160 && first_setting <= 180;
  return wanted.present == kAll || (wanted.present == kSagStretchPitch && is_usual);
}

}  // namespace bench
