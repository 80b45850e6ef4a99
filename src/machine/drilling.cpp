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
  if (modal_.motion <= gcode::kNoMotion) cycle_.begin(program_.aim().z);
  modal_.motion = cycle;
}

bool Drilling::refuse(gcode::DrillFault fault) { return answers_.refuseWords(textOf(fault)); }

bool Drilling::drill(const gcode::Words& words) {
  if (modal_.plane != 17)
    return answers_.refuseWords(FLASH("holes are drilled in the plane of G17 only"));
  if (modal_.inverse_time || modal_.machine_coordinates)
    return answers_.refuseWords(FLASH("no hole is drilled with G53 or G93"));
  if (!coordinates_.mayCrossSheet()) return false;
  const Place at = program_.counted();
  const float from[] = {at.x, at.y, at.z};
  const float offset[] = {coordinates_.begin(0), coordinates_.begin(1), coordinates_.begin(2)};
  const gcode::DrillFault fault = cycle_.read(modal_, words, from, offset);
  if (fault != gcode::DrillFault::kNone) return refuse(fault);
  gcode::DrillStep step;
  while (cycle_.next(step))
    if (!runStep(step)) return false;
  return true;
}

bool Drilling::runStep(const gcode::DrillStep& step) {
  if (step.kind == gcode::DrillStep::kDwell)
    return waiting_.drain() && waiting_.dwell(cycle_.dwell());
  const bool across = step.kind == gcode::DrillStep::kAcross;
  const float feed = moves_.feedOf(step.kind == gcode::DrillStep::kFeed ? 1 : 0);
  const float z = z_.within(step.z);
  if (across) {
    if (!moves_.moveStraight({step.x, step.y, program_.aim().z}, true, feed)) return false;
    // Beyond the sheet the sled stays at the edge, so the hole would be in a wrong place.
    return !program_.isCountedBeyond() ||
           answers_.refuseMotion(FLASH("the hole is beyond the sheet"));
  }
  Place next = program_.counted();
  next.z = z;
  return moves_.moveStraight(next, false, feed);
}

}  // namespace machine
