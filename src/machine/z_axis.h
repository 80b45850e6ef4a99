// The z axis: its limits (B17 to B20), its declared height, its speed.
#pragma once

#include <math.h>

#include "sled_place.h"

namespace machine {

/// [mm] No z goes farther. A limit of this size is none.
const float kMostZ = 10000;

/// Limits are in machine coordinates; they shift when z is declared.
class ZAxis {
 public:
  explicit ZAxis(Parts& parts) : parts_(parts) {}

  bool hasMotor() const;
  float mostFeed() const;      ///< [mm/min]
  float acceleration() const;  ///< [mm/s^2]
  /// [mm] z limited to the allowed range. A z that no axis reaches stays, to be refused.
  float within(float z) const;
  /// Whether an axis reaches that z [mm].
  static bool reaches(float z) { return float(fabs(z)) <= kMostZ; }
  bool setLimit(bool upper);
  bool clearLimits();
  bool showLimits();
  /// Declares that the tool is at this z [mm].
  void declare(float z);
  /// Declares z during a hold: the planned heights stay.
  void declareInHold(float z);

 private:
  void sayLimit(float limit);
  void shiftLimits(float shift);

  Parts& parts_;
};

}  // namespace machine
