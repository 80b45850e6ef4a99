// Drilling cycles, G81 to G83: the steps of a hole.
#pragma once

#include <stdint.h>

#include "modal.h"
#include "words.h"

namespace gcode {

/// Why a line is refused.
enum class DrillFault : uint8_t {
  kNone,
  kNoDepth,    ///< no Z or no R, in this line or before
  kTooFar,     ///< the hole's bottom or R is more than 10 m from zero
  kUpward,     ///< the hole's bottom is above R
  kNoPeck,     ///< G83 without Q, or Q is below 0.01 mm
  kBadRepeat,  ///< L or K is not a whole number from 1 to 999
  kBadDwell,   ///< P is below zero, or an hour or more
};

/// A step of a hole.
struct DrillStep {
  enum Kind : uint8_t { kAcross, kRapid, kFeed, kDwell } kind;
  float x, y;  ///< [mm] kAcross: where the hole is
  float z;     ///< [mm] kRapid, kFeed: where z goes
};

/// A cycle in force. Z, R, Q and P stay until G80 or another motion. Z and R are machine
/// coordinates [mm], Q is a size [mm], P a time [ms].
class Drilling {
 public:
  /// Begins a cycle with z at `z` [mm]: words of an earlier cycle no longer count.
  void begin(float z);

  /// Reads the words of a line. `from` are the machine's x, y, z [mm] now, `offset` [mm] where the
  /// program's coordinates begin.
  DrillFault read(const Modal& modal, const Words& words, const float (&from)[3],
                  const float (&offset)[3]);

  /// The next step of the line's holes; false after the last.
  bool next(DrillStep& step);

  uint32_t dwell() const { return dwell_ms_; }  ///< [ms] at the bottom, with G82

 private:
  enum class At : uint8_t {
    kStart,
    kAcross,
    kAbove,
    kDown,
    kPecked,
    kReturn,
    kBottom,
    kUp,
    kOn,
    kDone
  };

  DrillFault readSizes(const Modal& modal, const Words& words);
  DrillFault readRepeat(const Words& words);
  /// Does what is next; returns whether that is a step, or nothing moves.
  bool advance(DrillStep& step);
  bool moveZ(DrillStep& step, DrillStep::Kind kind, float z, At then);
  void goOn();

  float initial_z_ = 0;                 ///< [mm] where z was before the cycle
  float r_word_ = 0, bottom_word_ = 0;  ///< [mm] as in the program
  float peck_ = 0;                      ///< [mm] Q
  uint32_t dwell_ms_ = 0;
  bool has_bottom_ = false, has_r_ = false;
  // The line that is being drilled; lengths in machine coordinates [mm].
  uint8_t cycle_ = kDrill;
  uint16_t holes_left_ = 0;
  float x_ = 0, y_ = 0, step_x_ = 0, step_y_ = 0;  ///< the next hole, and the way on
  float r_ = 0, bottom_ = 0, clear_z_ = 0;         ///< and where z is after a hole
  float z_ = 0, depth_ = 0;                        ///< where z is; how deep the hole is
  At at_ = At::kDone;
};

}  // namespace gcode
