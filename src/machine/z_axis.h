// The z axis: its limits (B17 to B20), what it is declared to be, how fast it goes.
#pragma once

#include "answers.h"
#include "sled_place.h"

namespace machine {

/// Limits are kept in machine coordinates of the moment; they move along when z is declared.
class ZAxis {
 public:
  ZAxis(settings::Memory& memory, const settings::Values& values, Axes& axes, SledPlace& place,
        const gcode::Modal& modal, Printer& out, Answers& answers)
      : memory_(memory),
        values_(values),
        axes_(axes),
        place_(place),
        modal_(modal),
        out_(out),
        answers_(answers) {}

  bool hasMotor() const { return values_.at(kZMotor) != 0; }
  float mostFeed() const;                                            ///< [mm/min]
  float acceleration() const { return values_.at(kAccelerationZ); }  ///< [mm/s^2]
  float within(float z) const;  ///< [mm] brought back to the limits
  bool setLimit(bool upper);
  bool clearLimits();
  bool showLimits();
  /// The tool is at this z from now on [mm].
  void declare(float z);
  /// The same while the program's way is held: it keeps its heights.
  void declareInHold(float z);

 private:
  void sayLimit(float limit);
  void shiftLimits(float shift);

  settings::Memory& memory_;
  const settings::Values& values_;
  Axes& axes_;
  SledPlace& place_;
  const gcode::Modal& modal_;
  Printer& out_;
  Answers& answers_;
};

}  // namespace machine
