// One axis: its tick, then what the main program sets between ticks.
#include "ticked_axis.h"

#include "settings_table.h"

namespace machine {
namespace {

using motion::Fault;
using motion::Gains;

const float kCountsMissed = 2;  // [encoder counts] an illegal step is two edges at once
const float kShareOfLimit = 8;  // missed steps may take an eighth of the position error's limit

Gains gainsFrom(const settings::Values& values, uint8_t first) {
  return {values.at(first), values.at(uint8_t(first + 1)), values.at(uint8_t(first + 2)),
          values.at(uint8_t(first + 3))};
}

}  // namespace

int32_t TickedAxis::tick() {
  readEncoder();
  const float turned = scale_.turnsOf(moved_);
  loop_.measure(turned);
  int32_t off = 0;
  if (mode_ == AxisMode::kOff) {
    letGoInTime();
    return off;
  }
  if (mode_ == AxisMode::kFollow) {
    if (is_simulated_) {
      const int32_t counts = scale_.countsOf(motion::toMm<float>(set_point_));
      if (counts_ != counts) is_imagined_ = true;
      counts_ = counts;
      return off;
    }
    off = followSetPoint(turned);
  } else if (mode_ == AxisMode::kTurn) {
    duty_ = loop_.run(rpm_);
  }
  // A positive drive winds chain in; a positive duty here pays it out.
  const int16_t drive = mode_ == AxisMode::kOpen ? duty_ : int16_t(-duty_);
  if (!is_simulated_) drives_.drive(axis_, scale_.isReversed() ? int16_t(-drive) : drive);
  return off;
}

void TickedAxis::readEncoder() {
  const uint16_t raw = drives_.count(axis_);
  moved_ = int16_t(raw - raw_);
  raw_ = raw;
  if (!is_simulated_) {
    counts_ += moved_;
    return;
  }
  const int16_t kAstray = 12;  // [encoder counts] 0.1 mm of chain
  astray_ = int16_t(astray_ + moved_);
  if (astray_ > kAstray || astray_ < -kAstray) is_imagined_ = true;
}

int32_t TickedAxis::followSetPoint(float turned) {
  const int32_t ahead = set_point_ - measured();
  const int32_t size = ahead < 0 ? -ahead : ahead;
  if (size > most_behind_) most_behind_ = size;
  const float error = motion::toMm<float>(ahead);
  const float asked = asked_ == 0 ? 0 : scale_.turnsOfFine(asked_);
  duty_ = loop_.follow(scale_.turnsOfMm(error), asked, turned);
  const Fault seen = watch_.look(duty_, moved_, error);
  if (!is_held_) return 0;
  if (seen != Fault::kNone) note(seen);
  return size;
}

void TickedAxis::note(Fault seen) {
  if (seen != Fault::kLeftBehind) is_disproved_ = true;
  if (seen > fault_) fault_ = seen;
}

bool TickedAxis::prepare(const settings::Values& values, float seconds_per_tick) {
  const bool z = axis_ == kZAxis;
  const float counts = values.at(z ? kZCounts : kEncoderCounts);
  const float limit = values.at(kPositionErrorLimit);
  const float was_long = withinTravel(length());
  const bool is_rescaled = scale_.set(counts, values.at(z ? kZPerTurn : kChainPerTurn));
  if (is_rescaled) counts_ = scale_.countsOf(was_long);
  const float missed = limit / kShareOfLimit / (kCountsMissed * float(fabs(scale_.mmPerCount())));
  most_missed_ = missed < UINT16_MAX ? uint16_t(missed) : uint16_t(UINT16_MAX);
  const uint8_t position = z ? kZPositionP : kMainPositionP;
  loop_.tune(gainsFrom(values, position), gainsFrom(values, z ? kZSpeedP : kMainSpeedP),
             float(fabs(counts)), seconds_per_tick);
  watch_.tune(limit, float(fabs(counts)), seconds_per_tick);
  is_held_ = values.at(position) > 0;
  return is_rescaled;
}

int32_t TickedAxis::mostBehind() {
  const int32_t most = most_behind_;
  most_behind_ = 0;
  return most;
}

void TickedAxis::declare(float length) {
  length = withinTravel(length);
  if (is_simulated_) is_imagined_ = true;
  counts_ = scale_.countsOf(length);
  set_point_ = motion::toCounts(length);
  forgetMissed();
}

void TickedAxis::forgetRawCount() {
  raw_ = drives_.count(axis_);
  forgetMissed();
}

bool TickedAxis::hasMissedSteps() const {
  const uint16_t missed = uint16_t(drives_.illegalSteps(axis_) - missed_before_);
  return missed > most_missed_ && !is_simulated_;
}

void TickedAxis::follow() {
  fault_ = Fault::kNone;
  is_disproved_ = false;
  if (mode_ == AxisMode::kFollow) return;
  loop_.rest();
  watch_.rest();
  mode_ = AxisMode::kFollow;
}

void TickedAxis::release() {
  mode_ = AxisMode::kOff;
  duty_ = 0;
  braking_ = 0;
  drives_.release(axis_);
}

void TickedAxis::brake(uint8_t ticks) {
  release();
  drives_.brake(axis_);
  braking_ = ticks;
}

void TickedAxis::letGoInTime() {
  if (braking_ != 0 && --braking_ == 0) drives_.release(axis_);
}

void TickedAxis::driveOpen(int16_t duty) {
  mode_ = AxisMode::kOpen;
  duty_ = duty > 255 ? 255 : duty < -255 ? -255 : duty;
}

void TickedAxis::turn(float rpm) {
  if (mode_ != AxisMode::kTurn) loop_.rest();
  mode_ = AxisMode::kTurn;
  rpm_ = rpm;
}

void TickedAxis::simulate(bool on) {
  if (on && !is_simulated_) {
    is_imagined_ = false;
    astray_ = 0;
  }
  is_simulated_ = on;
}

motion::Fault TickedAxis::fault() {
  const Fault was = fault_;
  fault_ = Fault::kNone;
  return was;
}

}  // namespace machine
