// Limits of z, and how they move when z is declared.
#include "z_axis.h"

namespace machine {
float ZAxis::mostFeed() const { return values_.at(kZSpeed) * float(fabs(values_.at(kZPerTurn))); }

float ZAxis::within(float z) const {
  const float high = values_.at(kZUpperLimit), low = values_.at(kZLowerLimit);
  if (!reaches(z)) return z;
  if (z > high) return high;
  return z < low ? low : z;
}

bool ZAxis::setLimit(bool upper) {
  const float z = axes_.length(kZAxis);
  const settings::Refusal refusal = memory_.setRow(upper ? kZUpperLimit : kZLowerLimit, z);
  if (refusal != settings::Refusal::kNone)
    return answers_.refuse(FLASH("that is no z at which a limit can be"));
  out_ << (upper ? FLASH("Upper") : FLASH("Lower")) << FLASH(" limit set to: ");
  out_.fixed(modal_.fromMm(z), 2).end();
  return true;
}

bool ZAxis::clearLimits() {
  memory_.setRow(kZUpperLimit, kMostZ);
  memory_.setRow(kZLowerLimit, -kMostZ);
  out_.line(FLASH("Z Axis Limits Cleared"));
  return true;
}

void ZAxis::sayLimit(float limit) {
  if (float(fabs(limit)) >= kMostZ)
    out_ << FLASH("NAN");
  else
    out_.fixed(modal_.fromMm(limit), 2);
}

bool ZAxis::showLimits() {
  out_ << FLASH("Z Axis Upper Limit: ");
  sayLimit(values_.at(kZUpperLimit));
  out_ << FLASH(" Lower Limit: ");
  sayLimit(values_.at(kZLowerLimit));
  out_.end();
  return true;
}

void ZAxis::declare(float z) {
  const float shift = z - axes_.length(kZAxis);
  place_.declareZ(z);
  shiftLimits(shift);
}

void ZAxis::declareInHold(float z) {
  const float shift = z - axes_.length(kZAxis);
  axes_.declareLifted(z);
  place_.trustZ();
  shiftLimits(shift);
}

void ZAxis::shiftLimits(float shift) {
  const float high = values_.at(kZUpperLimit), low = values_.at(kZLowerLimit);
  if (high < kMostZ) memory_.setRow(kZUpperLimit, high + shift);
  if (low > -kMostZ) memory_.setRow(kZLowerLimit, low + shift);
}

}  // namespace machine
