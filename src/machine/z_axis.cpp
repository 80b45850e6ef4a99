// Limits of z, and how they move when z is declared.
#include "z_axis.h"

namespace machine {
float ZAxis::mostFeed() const {
  return base_.values.at(kZSpeed) * float(fabs(base_.values.at(kZPerTurn)));
}

float ZAxis::within(float z) const {
  const float high = base_.values.at(kZUpperLimit), low = base_.values.at(kZLowerLimit);
  if (!reaches(z)) return z;
  if (z > high) return high;
  return z < low ? low : z;
}

bool ZAxis::setLimit(bool upper) {
  const float z = base_.axes.length(kZAxis);
  const settings::Refusal refusal = base_.memory.setRow(upper ? kZUpperLimit : kZLowerLimit, z);
  if (refusal != settings::Refusal::kNone)
    return base_.answers.refuse(FLASH("that is no z at which a limit can be"));
  base_.out << (upper ? FLASH("Upper") : FLASH("Lower")) << FLASH(" limit set to: ");
  base_.out.fixed(base_.modal.fromMm(z), 2).end();
  return true;
}

bool ZAxis::clearLimits() {
  base_.memory.setRow(kZUpperLimit, kMostZ);
  base_.memory.setRow(kZLowerLimit, -kMostZ);
  base_.out.line(FLASH("Z Axis Limits Cleared"));
  return true;
}

void ZAxis::sayLimit(float limit) {
  if (float(fabs(limit)) >= kMostZ)
    base_.out << FLASH("NAN");
  else
    base_.out.fixed(base_.modal.fromMm(limit), 2);
}

bool ZAxis::showLimits() {
  base_.out << FLASH("Z Axis Upper Limit: ");
  sayLimit(base_.values.at(kZUpperLimit));
  base_.out << FLASH(" Lower Limit: ");
  sayLimit(base_.values.at(kZLowerLimit));
  base_.out.end();
  return true;
}

void ZAxis::declare(float z) {
  const float shift = z - base_.axes.length(kZAxis);
  place_.declareZ(z);
  shiftLimits(shift);
}

void ZAxis::declareInHold(float z) {
  const float shift = z - base_.axes.length(kZAxis);
  base_.axes.declareLifted(z);
  base_.keeper.declareZ();
  shiftLimits(shift);
}

void ZAxis::shiftLimits(float shift) {
  const float high = base_.values.at(kZUpperLimit), low = base_.values.at(kZLowerLimit);
  if (high < kMostZ) base_.memory.setRow(kZUpperLimit, high + shift);
  if (low > -kMostZ) base_.memory.setRow(kZLowerLimit, low + shift);
}

}  // namespace machine
