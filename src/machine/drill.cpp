// Drilling cycles: the steps of lib/GCode as moves.
#include "machine.h"

namespace machine {

bool Machine::beginCycle(const gcode::Piece& piece) {
  if (modal_.motion <= gcode::kNoMotion) drilling_.begin(aim_.z);
  modal_.motion = uint8_t(piece.tenths / 10);
  return moveInMode(piece.words);
}

bool Machine::refuseDrilling(gcode::DrillFault fault) {
  using gcode::DrillFault;
  switch (fault) {
    case DrillFault::kNoDepth:
      return refuseMotion(FLASH("a hole needs R and Z"));
    case DrillFault::kUpward:
      return refuseMotion(FLASH("a hole's Z is below its R"));
    case DrillFault::kNoPeck:
      return refuseMotion(FLASH("G83 needs Q, the depth of a peck"));
    case DrillFault::kBadRepeat:
      return refuseMotion(FLASH("L and K are whole numbers from 1 to 999"));
    default:
      return refuseMotion(FLASH("P is milliseconds, less than an hour"));
  }
}

bool Machine::drill(const Words& words) {
  if (modal_.plane != 17) return refuseMotion(FLASH("holes are drilled in the plane of G17 only"));
  if (modal_.inverse_time || modal_.machine_coordinates)
    return refuseMotion(FLASH("no hole is drilled with G53 or G93"));
  refreshGeometry();
  const float from[] = {counted_.x, counted_.y, aim_.z};
  const float offset[] = {offsets_.at(modal_.system, 0), offsets_.at(modal_.system, 1),
                          offsets_.at(modal_.system, 2)};
  const gcode::DrillFault fault = drilling_.read(modal_, words, from, offset);
  if (fault != gcode::DrillFault::kNone) return refuseDrilling(fault);
  gcode::DrillStep step;
  while (drilling_.next(step))
    if (!runDrillStep(step)) return false;
  return true;
}

bool Machine::runDrillStep(const gcode::DrillStep& step) {
  if (step.kind == gcode::DrillStep::kDwell) return drain() && waitFor(drilling_.dwell());
  const bool across = step.kind == gcode::DrillStep::kAcross;
  const float most = values_.at(kGreatestFeed);
  const float feed =
      step.kind == gcode::DrillStep::kFeed && modal_.feed < most ? modal_.feed : most;
  const float z = withinZLimits(step.z);
  if (across) {
    if (!moveStraight({step.x, step.y, aim_.z}, true, feed)) return false;
    // There the sled stays at the edge; the hole would be where nobody wants it.
    const bool is_there = counted_.x == aim_.x && counted_.y == aim_.y;
    return is_there || refuseMotion(FLASH("the hole is beyond the sheet"));
  }
  return moveStraight({counted_.x, counted_.y, z}, false, feed);
}

}  // namespace machine
