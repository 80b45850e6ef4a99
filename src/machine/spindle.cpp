// Spindle and laser: relay or servo, by setting $17.
#include "machine.h"

namespace machine {
namespace {

enum SpindleKind : uint8_t { kNone, kServo, kRelayHigh, kRelayLow };

const uint8_t kIdleAngle = 90, kOnAngle = 180, kOffAngle = 0;  // [degrees]
const uint16_t kServoMs = 2000;                                // for each turn of the servo
const uint16_t kSwitchedMs = 1000;  // for the spindle to gain or lose speed

}  // namespace

bool Machine::turnServo(uint8_t angle) {
  const uint8_t angles[] = {kIdleAngle, angle, kIdleAngle};
  bool completed = true;
  for (uint8_t i = 0; i < 3 && completed; ++i) {
    aux_.turnServo(angles[i]);
    completed = waitFor(kServoMs);
  }
  aux_.turnServo(kNoServo);
  return completed;
}

bool Machine::switchSpindle(bool on) {
  const SpindleKind kind = SpindleKind(values_.at(kSpindle));
  if (kind == kNone) return true;
  out_.line(on ? FLASH("Turning Spindle On") : FLASH("Turning Spindle Off"));
  if (kind == kServo) {
    if (!turnServo(on ? kOnAngle : kOffAngle)) return false;
  } else {
    aux_.set(Output::kSpindle, on == (kind == kRelayHigh));
  }
  return waitFor(kSwitchedMs);
}

void Machine::restSpindle() {
  const SpindleKind kind = SpindleKind(values_.at(kSpindle));
  if (kind == kRelayHigh || kind == kRelayLow) aux_.set(Output::kSpindle, kind == kRelayLow);
}

void Machine::switchLaser(bool on) {
  aux_.set(Output::kLaser, on);
  out_.line(on ? FLASH("Laser on") : FLASH("Laser off"));
}

}  // namespace machine
