// Limits of z (B17 to B20): kept in machine coordinates of the moment, moved along when z is
// declared anew.
#include "machine.h"

namespace machine {
namespace {

const float kNoLimit = 10000;  // [mm] the table's "none"

}  // namespace

float Machine::withinZLimits(float z) const {
  const float high = values_.at(kZUpperLimit), low = values_.at(kZLowerLimit);
  if (z > high) return high;
  return z < low ? low : z;
}

bool Machine::setZLimit(bool upper) {
  const float z = axes_.length(kZAxis);
  const settings::Refusal refusal = memory_.setRow(upper ? kZUpperLimit : kZLowerLimit, z);
  if (refusal != settings::Refusal::kNone)
    return refuse(FLASH("that is no z at which a limit can be"));
  out_ << (upper ? FLASH("Upper") : FLASH("Lower")) << FLASH(" limit set to: ");
  out_.fixed(inUnits(z), 2).end();
  return true;
}

bool Machine::clearZLimits() {
  memory_.setRow(kZUpperLimit, kNoLimit);
  memory_.setRow(kZLowerLimit, -kNoLimit);
  out_.line(FLASH("Z Axis Limits Cleared"));
  return true;
}

void Machine::sayZLimit(float limit) {
  if (float(fabs(limit)) >= kNoLimit)
    out_ << FLASH("NAN");
  else
    out_.fixed(inUnits(limit), 2);
}

bool Machine::showZLimits() {
  out_ << FLASH("Z Axis Upper Limit: ");
  sayZLimit(values_.at(kZUpperLimit));
  out_ << FLASH(" Lower Limit: ");
  sayZLimit(values_.at(kZLowerLimit));
  out_.end();
  return true;
}

void Machine::declareZ(float z) {
  const float shift = z - axes_.length(kZAxis);
  axes_.declare(kZAxis, z);
  aim_.z = z;
  mover_.standAt(axes_.setPoint());
  shiftZLimits(shift);
  keeper_.declareZ();
}

void Machine::shiftZLimits(float shift) {
  const float high = values_.at(kZUpperLimit), low = values_.at(kZLowerLimit);
  if (high < kNoLimit) memory_.setRow(kZUpperLimit, high + shift);
  if (low > -kNoLimit) memory_.setRow(kZLowerLimit, low + shift);
}

}  // namespace machine
