// The cases of quadrilateral_program.cpp, a line each; the board's program and the simulator's
// program read them.
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

/// Number of equal parts between two marks, for cycles of a single part.
inline unsigned partsOf(const Case&) { return 1; }

}  // namespace bench
