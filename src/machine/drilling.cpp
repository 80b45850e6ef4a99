// The steps of a hole as moves.
#include "parts.h"

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
  if (parts_.modal.motion <= gcode::kNoMotion) cycle_.begin(parts_.program.aim().z);
  parts_.modal.motion = cycle;
}

bool Drilling::refuse(gcode::DrillFault fault) { return parts_.answers.refuseWords(textOf(fault)); }

bool Drilling::drill(const gcode::Words& words) {
  if (parts_.modal.plane != 17)
    return parts_.answers.refuseWords(FLASH("holes are drilled in the plane of G17 only"));
  if (parts_.modal.inverse_time || parts_.modal.machine_coordinates)
    return parts_.answers.refuseWords(FLASH("no hole is drilled with G53 or G93"));
  if (!parts_.coordinates.mayCrossSheet()) return false;
  const Place at = parts_.program.counted();
  const float from[] = {at.x, at.y, at.z};
  const float offset[] = {parts_.coordinates.begin(0), parts_.coordinates.begin(1),
                          parts_.coordinates.begin(2)};
  const gcode::DrillFault fault = cycle_.read(parts_.modal, words, from, offset);
  if (fault != gcode::DrillFault::kNone) return refuse(fault);
  gcode::DrillStep step;
  while (cycle_.next(step))
    if (!runStep(step)) return false;
  return true;
}

bool Drilling::runStep(const gcode::DrillStep& step) {
  if (step.kind == gcode::DrillStep::kDwell)
    return parts_.waiting.drain() && parts_.waiting.dwell(cycle_.dwell());
  const bool across = step.kind == gcode::DrillStep::kAcross;
  const float feed = parts_.moves.feedOf(step.kind == gcode::DrillStep::kFeed ? 1 : 0);
  const float z = parts_.z.within(step.z);
  if (across) {
    if (!parts_.moves.moveStraight({step.x, step.y, parts_.program.aim().z}, true, feed))
      return false;
    // Beyond the sheet the sled stays at the edge, so the hole would be in a wrong place.
    return !parts_.program.isCountedBeyond() ||
           parts_.answers.refuseMotion(FLASH("the hole is beyond the sheet"));
  }
  Place next = parts_.program.counted();
  next.z = z;
  return parts_.moves.moveStraight(next, false, feed);
}

}  // namespace machine
