// Spindle and laser: relay or servo, by setting $17.
#include "machine.h"

namespace machine {
namespace {

enum SpindleKind : uint8_t { kNone, kServo, kRelayHigh, kRelayLow };

const uint8_t kIdleAngle = 90, kOnAngle = 180, kOffAngle = 0;  // [degrees]
const uint16_t kServoMs = 2000;   // for each turn of the servo
const uint16_t kSwitchedMs = 1000;  // for the spindle to gain or lose speed

}  // namespace

bool Machine::turnServo(uint8_t angle) {
  const uint8_t angles[] = {kIdleAngle, angle, kIdleAngle};
  bool completed = true;
  for (uint8_t i = 0; i < 3 && completed; ++i) {
    aux.turnServo(angles[i]);
    completed = waitFor(kServoMs);
  }
  aux.turnServo(kNoServo);
  return completed;
}

bool Machine::switchSpindle(bool on) {
  const SpindleKind kind = SpindleKind(values.at(kSpindle));
  if (kind == kNone) return true;
  out.line(on ? FLASH("Turning Spindle On") : FLASH("Turning Spindle Off"));
  if (kind == kServo) {
    if (!turnServo(on ? kOnAngle : kOffAngle)) return false;
  } else {
    aux.set(Output::kSpindle, on == (kind == kRelayHigh));
  }
  return waitFor(kSwitchedMs);
}

void Machine::restSpindle() {
  const SpindleKind kind = SpindleKind(values.at(kSpindle));
  if (kind == kRelayHigh || kind == kRelayLow) aux.set(Output::kSpindle, kind == kRelayLow);
}

void Machine::switchLaser(bool on) {
  aux.set(Output::kLaser, on);
  out.line(on ? FLASH("Laser on") : FLASH("Laser off"));
}

}  // namespace machine
