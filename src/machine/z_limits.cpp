// Limits of z (B17 to B20): kept in machine coordinates of the moment, moved along when z is
// declared anew.
#include "machine.h"

namespace machine {
namespace {

const float kNoLimit = 10000;  // [mm] the table's "none"

}  // namespace

float Machine::withinZLimits(float z) const {
  const float high = values.at(kZUpperLimit), low = values.at(kZLowerLimit);
  if (z > high) return high;
  return z < low ? low : z;
}

bool Machine::setZLimit(bool upper) {
  const float z = axes.length(kZAxis);
  const settings::Refusal refusal = memory.setRow(upper ? kZUpperLimit : kZLowerLimit, z);
  if (refusal != settings::Refusal::kNone) return refuse(FLASH("that is no z at which a limit can be"));
  out << (upper ? FLASH("Upper") : FLASH("Lower")) << FLASH(" limit set to: ");
  out.fixed(inUnits(z), 2).end();
  return true;
}

bool Machine::clearZLimits() {
  memory.setRow(kZUpperLimit, kNoLimit);
  memory.setRow(kZLowerLimit, -kNoLimit);
  out.line(FLASH("Z Axis Limits Cleared"));
  return true;
}

void Machine::sayZLimit(float limit) {
  if (float(fabs(limit)) >= kNoLimit)
    out << FLASH("NAN");
  else
    out.fixed(inUnits(limit), 2);
}

bool Machine::showZLimits() {
  out << FLASH("Z Axis Upper Limit: ");
  sayZLimit(values.at(kZUpperLimit));
  out << FLASH(" Lower Limit: ");
  sayZLimit(values.at(kZLowerLimit));
  out.end();
  return true;
}

void Machine::declareZ(float z) {
  const float shift = z - axes.length(kZAxis);
  axes.declare(kZAxis, z);
  axes.standStill();
  standHere();
  const float high = values.at(kZUpperLimit), low = values.at(kZLowerLimit);
  if (high < kNoLimit) memory.setRow(kZUpperLimit, high + shift);
  if (low > -kNoLimit) memory.setRow(kZLowerLimit, low + shift);
  keepPosition();
}

}  // namespace machine
