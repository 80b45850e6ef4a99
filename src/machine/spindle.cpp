// Commands to the spindle, with the angles and times of the published firmware.
#include "parts.h"

namespace machine {
namespace {

const uint8_t kIdleAngle = 90, kOnAngle = 180, kOffAngle = 0;  // [degrees]
const uint16_t kServoMs = 2000;                                // for each turn of the servo
const uint16_t kSwitchedMs = 1000;  // for the spindle to gain or lose speed

}  // namespace

bool Spindle::turnServo(uint8_t angle) {
  const uint8_t angles[] = {kIdleAngle, angle, kIdleAngle};
  bool completed = true;
  for (uint8_t i = 0; i < 3 && completed; ++i) {
    parts_.aux.turnServo(angles[i]);
    completed = parts_.waiting.waitFor(kServoMs);
  }
  parts_.aux.turnServo(kNoServo);
  return completed;
}

bool Spindle::turn(bool on) {
  const SpindleKind kind = parts_.cutter.kind();
  if (kind == SpindleKind::kNone) return true;
  parts_.out.line(on ? FLASH("Turning Spindle On") : FLASH("Turning Spindle Off"));
  parts_.cutter.setSpindle(on);
  if (kind == SpindleKind::kServo && !turnServo(on ? kOnAngle : kOffAngle)) return false;
  return parts_.waiting.waitFor(kSwitchedMs);
}

bool Spindle::takeS(const gcode::Words& words) {
  if (!words.has('S')) return true;
  const float s = words.value('S');
  // Moves before the S word are made at the old speed.
  if (parts_.cutter.changesSpeed(s) && !parts_.waiting.drain()) return false;
  parts_.cutter.takeS(s);
  return true;
}

void Spindle::switchLaser(bool on) {
  const bool changes = parts_.cutter.isArmed() != on;
  parts_.cutter.arm(on);
  // Maslow clients expect this at each stop.
  if (changes || !parts_.out.speaksGrbl())
    parts_.out.line(on ? FLASH("Laser on") : FLASH("Laser off"));
}

}  // namespace machine
