// The cases of motion_program.cpp, a line each; the board's program and the simulator's program
// read them.
#pragma once

#include <stdint.h>

namespace bench {

enum What : uint8_t { kNothing, kTick, kTake, kMove, kShortMoves };
enum Shape : uint8_t { kLine, kArc };

// Ticks of a timed move from rest to rest: 120 mm at 900 mm/min and 100 mm/s^2, 10 ms a tick.
enum : uint16_t { kMoveTicks = 817 };

struct Case {
  const char* name;
  What what;
  Shape shape;
  uint16_t radius;  // [mm] of an arc
  uint16_t ticks;   // between two marks; the figures are for a single tick
};

const Case kCases[] = {
    {"(marks alone)", kNothing, kLine, 0, 1},
    {"set-points of all axes, one tick", kTick, kLine, 0, 1},
    {"set-points taken in the control tick", kTake, kLine, 0, 1},
    {"a line of 120 mm from rest to rest, a tick", kMove, kLine, 0, kMoveTicks},
    {"the same, arc of 100 mm", kMove, kArc, 100, kMoveTicks},
    {"the same, arc of 20 mm", kMove, kArc, 20, kMoveTicks},
    {"a move of 0.2 mm, queued and walked", kShortMoves, kLine, 0, 200},
};

enum : uint8_t {
  kCaseCount = sizeof kCases / sizeof kCases[0],
  kColumns = 7,
  kRows = 4,
  kFinished = 255,
};

/// Number of equal parts between two marks, for cycles of a single part.
inline unsigned partsOf(const Case& timed) { return timed.ticks; }

}  // namespace bench
