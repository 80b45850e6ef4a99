// Overrides: the operator makes feeds, rapids and the spindle's speed slower or faster.
#pragma once

#include <GCode.h>

namespace machine {

struct Parts;

/// Percent of a number of the program, as quick characters change it in steps.
class Percent {
 public:
  enum : uint8_t { kLeast = 10, kUsual = 100, kMost = 200 };

  uint8_t now() const { return percent_; }

  /// Takes the step `quick`, counted from the character that asks for the usual percent: 10 up, 10
  /// down, 1 up, 1 down. False if nothing changes.
  bool take(gcode::Quick quick, gcode::Quick usual) {
    const uint8_t was = percent_;
    const uint8_t step = uint8_t(uint8_t(quick) - uint8_t(usual));
    const uint8_t by = step <= 2 ? 10 : 1;
    if (step == 0)
      percent_ = kUsual;
    else if (step % 2 == 1)
      percent_ = percent_ + by > kMost ? uint8_t(kMost) : uint8_t(percent_ + by);
    else
      percent_ = percent_ < kLeast + by ? uint8_t(kLeast) : uint8_t(percent_ - by);
    return percent_ != was;
  }

 private:
  uint8_t percent_ = kUsual;
};

/// All three overrides.
class Overrides {
 public:
  uint8_t feed() const { return feed_.now(); }        ///< [percent]
  uint8_t rapid() const { return rapid_; }            ///< [percent] 100, 50 or 25
  uint8_t spindle() const { return spindle_.now(); }  ///< [percent]

  /// Takes kFeedUsual to kSpindleDownOne; false if nothing changes.
  bool take(gcode::Quick quick) {
    using gcode::Quick;
    if (quick < Quick::kRapidFull) return feed_.take(quick, Quick::kFeedUsual);
    if (quick > Quick::kNoOverride) return spindle_.take(quick, Quick::kSpindleUsual);
    const uint8_t was = rapid_;
    if (quick != Quick::kNoOverride)
      rapid_ = uint8_t(100 >> (uint8_t(quick) - uint8_t(Quick::kRapidFull)));
    return rapid_ != was;
  }
  /// Back to the program's numbers; false if nothing changes.
  bool reset() {
    const bool changes = feed() != Percent::kUsual || rapid_ != 100 || spindle() != Percent::kUsual;
    *this = Overrides();
    return changes;
  }

  /// Factor for the feed of each move if it is above 1; slower feeds are done by shareOfPlan().
  float boost() const { return feed() > Percent::kUsual ? float(feed()) * 0.01f : 1; }
  /// Share [1] of the planned speed at which the axes follow the path.
  float shareOfPlan() const { return feed() < Percent::kUsual ? float(feed()) * 0.01f : 1; }

 private:
  Percent feed_, spindle_;
  uint8_t rapid_ = 100;
};

/// The overrides in force, handed to the axes, the planner and the cutter.
class LiveOverrides {
 public:
  explicit LiveOverrides(Parts& parts) : parts_(parts) {}

  void take(gcode::Quick quick);
  void reset();
  const Overrides& now() const { return now_; }

 private:
  void apply();

  Parts& parts_;
  Overrides now_;
};

}  // namespace machine
