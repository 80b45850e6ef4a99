// What is timed: one line a case, read by the board's program and by the simulator's.
#pragma once

#include <stdint.h>

namespace bench {

enum What : uint8_t { kNothing, kInverse, kForward, kForwardFar, kForwardNear };

// Which effects are present, by the number of their first setting.
enum Present : uint8_t { kNone, kSag, kSagStretch, kSagStretchPitch, kAll };

struct Case {
  const char* name;
  What what;
  Present present;
  bool off_bottom;
};

const Case kCases[] = {
    {"(marks alone)", kNothing, kNone, false},
    {"inverse, rigid", kInverse, kNone, false},
    {"inverse, sag", kInverse, kSag, false},
    {"inverse, sag and stretch", kInverse, kSagStretch, false},
    {"inverse, sag, stretch and pitch", kInverse, kSagStretchPitch, false},
    {"inverse, sag, stretch and pitch, off the bottom", kInverse, kSagStretchPitch, true},
    {"forward, no guess", kForward, kSagStretchPitch, false},
    {"forward, guess in the far corner", kForwardFar, kSagStretchPitch, false},
    {"forward, guess 0.1 mm off (tracking)", kForwardNear, kSagStretchPitch, false},
};

// Every second place of the published measurements' grid, borders included: all of them take four
// times as long, change no median by 0.1 % and no extreme by 2 %.
enum : uint8_t {
  kCaseCount = sizeof kCases / sizeof kCases[0],
  kColumns = 25,
  kRows = 13,
  kFinished = 255,
};

inline bool isPresent(Present present, int first_setting) {
  switch (present) {
    case kSag:
      return first_setting == 160;
    case kSagStretch:
      return first_setting == 160 || first_setting == 170;
    case kSagStretchPitch:
      return first_setting >= 160 && first_setting <= 180;
    case kAll:
      return true;
    default:
      return false;
  }
}

}  // namespace bench
