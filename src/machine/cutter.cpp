// Levels of the spindle's and the laser's pins.
#include "cutter.h"

namespace machine {

uint8_t Cutter::spindleLevel() const {
  const float most = values_.at(kSpindleMost), least = values_.at(kSpindleLeast);
  // If there was never an S word, full speed.
  float speed = (s_ > 0 ? s_ : most) * float(percent_) * 0.01f;
  if (speed < least) speed = least;
  if (speed > most) speed = most;
  return uint8_t(float(kFull) * speed / most + 0.5f);
}

void Cutter::setSpindle(bool on) {
  is_turning_ = on;
  // $17 has changed since.
  if (is_pulsed_ && kind() != SpindleKind::kPulsed) aux_.pulse(Output::kSpindle, 0);
  is_pulsed_ = on && kind() == SpindleKind::kPulsed;
  switch (kind()) {
    case SpindleKind::kRelayHigh:
    case SpindleKind::kRelayLow:
      aux_.set(Output::kSpindle, on == (kind() == SpindleKind::kRelayHigh));
      break;
    case SpindleKind::kPulsed:
      aux_.pulse(Output::kSpindle, on ? spindleLevel() : 0);
      break;
    default:
      break;
  }
}

void Cutter::takeS(float s) {
  const bool changes = changesSpeed(s);
  s_ = s;
  if (changes) setSpindle(true);
}

void Cutter::override(uint8_t percent) {
  percent_ = percent;
  if (is_pulsed_) setSpindle(true);
}

void Cutter::arm(bool yes) {
  is_armed_ = yes;
  if (yes) is_barred_ = false;
}

uint8_t Cutter::takeBeam() {
  const uint8_t beam = is_armed_ ? aimed_ : 0;
  aimed_ = 0;
  return beam;
}

uint8_t Cutter::beamOf(uint8_t motion) const {
  if (!is_armed_ || motion < 1 || motion > 3 || !(s_ > 0)) return 0;
  return s_ < float(kFull) ? uint8_t(s_ + 0.5f) : uint8_t(kFull);
}

void Cutter::show(uint8_t beam) {
  if (beam == 0 && shown_ == 0) return;
  const bool pulses = values_.at(kLaserPulses) != 0;
  const uint8_t level = is_barred_ || beam == 0 ? 0 : pulses ? beam : uint8_t(kFull);
  if (level == shown_) return;
  shown_ = level;
  if (pulses)
    aux_.pulse(Output::kLaser, level);
  else
    aux_.set(Output::kLaser, level != 0);
}

void Cutter::off() {
  is_barred_ = true;
  is_armed_ = false;
  shown_ = 0;
  aux_.set(Output::kLaser, false);
  setSpindle(false);
}

}  // namespace machine
