// Where a program's coordinates begin, in machine coordinates: G54 to G59, G92, G43.1.
#pragma once

#include <stdint.h>

namespace gcode {

/// Added to a program's coordinate they give the machine's. Axes are 0, 1, 2 for x, y, z.
///
/// The caller stores the six systems of G54 to G59. The shift of G92 and the tool's length are
/// stored here, and are lost with power.
class WorkOffsets {
 public:
  enum : uint8_t { kAxes = 3, kSystems = 6, kZ = 2 };

  /// `stored` [mm]: x, y and z of the first system, then of the second, up to the sixth system.
  explicit WorkOffsets(const float* stored) : stored_(stored) {}

  /// Where the coordinate of an axis begins [mm].
  float at(uint8_t system, uint8_t axis) const {
    return stored_[system * kAxes + axis] + shiftNow(axis) + toolAt(axis);
  }

  /// G10 L20: the number to store so that machine coordinate `machine` [mm] is called `word` [mm].
  float storedFor(uint8_t axis, float machine, float word) const {
    return machine - word - shiftNow(axis) - toolAt(axis);
  }

  /// G92: machine coordinate `machine` [mm] is called `word` [mm] in that system. All systems shift
  /// by the same amount.
  void shiftTo(uint8_t system, uint8_t axis, float machine, float word) {
    resumeShift();
    shift_[axis] = machine - word - stored_[system * kAxes + axis] - toolAt(axis);
  }
  /// G92.1, G92.2, G92.3.
  void clearShift() { shift_[0] = shift_[1] = shift_[kZ] = 0; }
  void suspendShift() { is_suspended_ = true; }
  void resumeShift() { is_suspended_ = false; }

  /// G43.1, G49: how far the tool's tip is beyond the tip with which z was set [mm].
  void setToolLength(float length) { tool_length_ = length; }
  float toolLength() const { return tool_length_; }

  /// How far G92 shifts an axis now [mm].
  float shiftNow(uint8_t axis) const { return is_suspended_ ? 0 : shift_[axis]; }

 private:
  float toolAt(uint8_t axis) const { return axis == kZ ? tool_length_ : 0; }

  const float* stored_;
  float shift_[kAxes] = {0, 0, 0};
  float tool_length_ = 0;
  bool is_suspended_ = false;
};

}  // namespace gcode
