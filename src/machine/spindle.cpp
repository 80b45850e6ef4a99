// Commands to the spindle, with the angles and times of the published firmware.
#include "spindle.h"

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
    aux_.turnServo(angles[i]);
    completed = waiting_.waitFor(kServoMs);
  }
  aux_.turnServo(kNoServo);
  return completed;
}

bool Spindle::turn(bool on) {
  const SpindleKind kind = cutter_.kind();
  if (kind == SpindleKind::kNone) return true;
  out_.line(on ? FLASH("Turning Spindle On") : FLASH("Turning Spindle Off"));
  cutter_.setSpindle(on);
  if (kind == SpindleKind::kServo && !turnServo(on ? kOnAngle : kOffAngle)) return false;
  return waiting_.waitFor(kSwitchedMs);
}

bool Spindle::takeS(const gcode::Words& words) {
  if (!words.has('S')) return true;
  const float s = words.value('S');
  // Moves before the S word are made at the old speed.
  if (cutter_.changesSpeed(s) && !waiting_.drain()) return false;
  cutter_.takeS(s);
  return true;
}

void Spindle::switchLaser(bool on) {
  const bool changes = cutter_.isArmed() != on;
  cutter_.arm(on);
  // Maslow clients hear it at each stop.
  if (changes || !out_.speaksGrbl()) out_.line(on ? FLASH("Laser on") : FLASH("Laser off"));
}

}  // namespace machine
