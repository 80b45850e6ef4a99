// What quadrilateral_program.cpp times: one line a case, read by the board's program and the
// simulator's.
#pragma once

#include <stdint.h>

namespace bench {

enum What : uint8_t { kNothing, kInverse, kInverseNear, kForward, kForwardFar, kForwardNear };

struct Case {
  const char* name;
  What what;
};

const Case kCases[] = {
    {"(marks alone)", kNothing},
    {"inverse, two brackets, no guess", kInverse},
    {"inverse, two brackets, tilt of 0.15 mm before", kInverseNear},
    {"forward, two brackets, no guess", kForward},
    {"forward, two brackets, guess in the far corner", kForwardFar},
    {"forward, two brackets, guess 0.1 mm off (tracking)", kForwardNear},
};

enum : uint8_t {
  kCaseCount = sizeof kCases / sizeof kCases[0],
  kColumns = 25,
  kRows = 13,
  kFinished = 255,
};

/// Into how many equal parts the cycles between two marks are divided.
inline unsigned partsOf(const Case&) { return 1; }

}  // namespace bench
