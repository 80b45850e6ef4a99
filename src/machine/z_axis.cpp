// Limits of z, and how they move when z is declared.
#include "parts.h"

namespace machine {
bool ZAxis::hasMotor() const { return parts_.values.at(kZMotor) != 0; }

float ZAxis::acceleration() const { return parts_.values.at(kAccelerationZ); }

float ZAxis::mostFeed() const {
  return parts_.values.at(kZSpeed) * float(fabs(parts_.values.at(kZPerTurn)));
}

float ZAxis::within(float z) const {
  const float high = parts_.values.at(kZUpperLimit), low = parts_.values.at(kZLowerLimit);
  if (!reaches(z)) return z;
  if (z > high) return high;
  return z < low ? low : z;
}

bool ZAxis::setLimit(bool upper) {
  const float z = parts_.axes.length(kZAxis);
  const settings::Refusal refusal = parts_.memory.setRow(upper ? kZUpperLimit : kZLowerLimit, z);
  if (refusal != settings::Refusal::kNone)
    return parts_.answers.refuse(FLASH("that is no z at which a limit can be"));
  parts_.out << (upper ? FLASH("Upper") : FLASH("Lower")) << FLASH(" limit set to: ");
  parts_.out.fixed(parts_.modal.fromMm(z), 2).end();
  return true;
}

bool ZAxis::clearLimits() {
  parts_.memory.setRow(kZUpperLimit, kMostZ);
  parts_.memory.setRow(kZLowerLimit, -kMostZ);
  parts_.out.line(FLASH("Z Axis Limits Cleared"));
  return true;
}

void ZAxis::sayLimit(float limit) {
  if (float(fabs(limit)) >= kMostZ)
    parts_.out << FLASH("NAN");
  else
    parts_.out.fixed(parts_.modal.fromMm(limit), 2);
}

bool ZAxis::showLimits() {
  parts_.out << FLASH("Z Axis Upper Limit: ");
  sayLimit(parts_.values.at(kZUpperLimit));
  parts_.out << FLASH(" Lower Limit: ");
  sayLimit(parts_.values.at(kZLowerLimit));
  parts_.out.end();
  return true;
}

void ZAxis::declare(float z) {
  const float shift = z - parts_.axes.length(kZAxis);
  parts_.place.declareZ(z);
  shiftLimits(shift);
}

void ZAxis::declareInHold(float z) {
  const float shift = z - parts_.axes.length(kZAxis);
  parts_.axes.declareLifted(z);
  parts_.keeper.declareZ();
  shiftLimits(shift);
}

void ZAxis::shiftLimits(float shift) {
  const float high = parts_.values.at(kZUpperLimit), low = parts_.values.at(kZLowerLimit);
  if (high < kMostZ) parts_.memory.setRow(kZUpperLimit, high + shift);
  if (low > -kMostZ) parts_.memory.setRow(kZLowerLimit, low + shift);
}

}  // namespace machine
