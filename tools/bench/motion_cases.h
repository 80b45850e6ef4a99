// What motion_program.cpp times: one line a case, read by the board's program and the simulator's.
#pragma once

#include <stdint.h>

namespace bench {

enum What : uint8_t { kNothing, kTick, kMove };
enum Shape : uint8_t { kLine, kArc };

// Ticks of a timed move: 120 mm at 900 mm/min, 10 ms a tick.
enum : uint16_t { kMoveTicks = 800 };

struct Case {
  const char* name;
  What what;
  Shape shape;
  uint16_t radius;  // [mm] of an arc
  uint16_t ticks;   // between two marks; the figures are for one of them
};

const Case kCases[] = {
    {"(marks alone)", kNothing, kLine, 0, 1},
    {"set-points of both chains, one tick", kTick, kLine, 0, 1},
    {"set-points, amortised with knots", kMove, kLine, 0, kMoveTicks},
    {"set-points, amortised with knots, arc of 100 mm", kMove, kArc, 100, kMoveTicks},
    {"set-points, amortised with knots, arc of 20 mm", kMove, kArc, 20, kMoveTicks},
};

enum : uint8_t {
  kCaseCount = sizeof kCases / sizeof kCases[0],
  kColumns = 7,
  kRows = 4,
  kFinished = 255,
};

/// Into how many equal parts the cycles between two marks are divided.
inline unsigned partsOf(const Case& timed) { return timed.ticks; }

}  // namespace bench
