// The steps of a hole as moves.
#include "drilling.h"

namespace machine {
namespace {

FlashText textOf(gcode::DrillFault fault) {
  using gcode::DrillFault;
  switch (fault) {
    case DrillFault::kNoDepth:
      return FLASH("a hole needs R and Z");
    case DrillFault::kTooFar:
      return FLASH("no z axis is that long: R or Z");
    case DrillFault::kUpward:
      return FLASH("a hole's Z is below its R");
    case DrillFault::kNoPeck:
      return FLASH("G83 needs Q, the depth of a peck, of 0.01 mm at least");
    case DrillFault::kBadRepeat:
      return FLASH("L and K are whole numbers from 1 to 999");
    default:
      return FLASH("P is milliseconds, less than an hour");
  }
}

}  // namespace

void Drilling::begin(uint8_t cycle) {
  if (base_.modal.motion <= gcode::kNoMotion) cycle_.begin(base_.program.aim().z);
  base_.modal.motion = cycle;
}

bool Drilling::refuse(gcode::DrillFault fault) { return base_.answers.refuseWords(textOf(fault)); }

bool Drilling::drill(const gcode::Words& words) {
  if (base_.modal.plane != 17)
    return base_.answers.refuseWords(FLASH("holes are drilled in the plane of G17 only"));
  if (base_.modal.inverse_time || base_.modal.machine_coordinates)
    return base_.answers.refuseWords(FLASH("no hole is drilled with G53 or G93"));
  if (!coordinates_.mayCrossSheet()) return false;
  const Place at = base_.program.counted();
  const float from[] = {at.x, at.y, at.z};
  const float offset[] = {coordinates_.begin(0), coordinates_.begin(1), coordinates_.begin(2)};
  const gcode::DrillFault fault = cycle_.read(base_.modal, words, from, offset);
  if (fault != gcode::DrillFault::kNone) return refuse(fault);
  gcode::DrillStep step;
  while (cycle_.next(step))
    if (!runStep(step)) return false;
  return true;
}

bool Drilling::runStep(const gcode::DrillStep& step) {
  if (step.kind == gcode::DrillStep::kDwell)
    return base_.waiting.drain() && base_.waiting.dwell(cycle_.dwell());
  const bool across = step.kind == gcode::DrillStep::kAcross;
  const float feed = moves_.feedOf(step.kind == gcode::DrillStep::kFeed ? 1 : 0);
  const float z = z_.within(step.z);
  if (across) {
    if (!moves_.moveStraight({step.x, step.y, base_.program.aim().z}, true, feed)) return false;
    // Beyond the sheet the sled stays at the edge, so the hole would be in a wrong place.
    return !base_.program.isCountedBeyond() ||
           base_.answers.refuseMotion(FLASH("the hole is beyond the sheet"));
  }
  Place next = base_.program.counted();
  next.z = z;
  return moves_.moveStraight(next, false, feed);
}

}  // namespace machine
