// A hole, step by step: up to R if z is below R, across, down to R, down at the feed, up again.
#include "drilling.h"

#include <math.h>

namespace gcode {
namespace {

// [mm] The rapid move of a peck ends this far above the bottom of the hole so far.
const float kPeckClearance = 0.25f;
const float kLeastPeck = 0.01f;  // [mm] a smaller peck would never come to an end
const float kMostZ = 10000;      // [mm]
const float kMostHoles = 999;
const float kMostDwell = 3600000;  // [ms]

}  // namespace

void Drilling::begin(float z) {
  initial_z_ = z;
  has_bottom_ = has_r_ = false;
  peck_ = 0;
  dwell_ms_ = 0;
}

DrillFault Drilling::readSizes(const Modal& modal, const Words& words) {
  if (words.has('Z')) bottom_word_ = modal.toMm(words.value('Z'));
  if (words.has('R')) r_word_ = modal.toMm(words.value('R'));
  has_bottom_ = has_bottom_ || words.has('Z');
  has_r_ = has_r_ || words.has('R');
  if (!has_bottom_ || !has_r_) return DrillFault::kNoDepth;
  if (words.has('Q')) peck_ = modal.toMm(words.value('Q'));
  if (modal.motion == kPeck && !(peck_ >= kLeastPeck)) return DrillFault::kNoPeck;
  const float dwell = words.has('P') ? words.value('P') : float(dwell_ms_);
  if (!(dwell >= 0 && dwell < kMostDwell)) return DrillFault::kBadDwell;
  dwell_ms_ = uint32_t(dwell);
  return DrillFault::kNone;
}

DrillFault Drilling::readRepeat(const Words& words) {
  const float holes = words.has('L') ? words.value('L') : words.has('K') ? words.value('K') : 1;
  if (!(holes >= 1 && holes <= kMostHoles && holes == float(floor(holes))))
    return DrillFault::kBadRepeat;
  holes_left_ = uint16_t(holes);
  return DrillFault::kNone;
}

DrillFault Drilling::read(const Modal& modal, const Words& words, const float (&from)[3],
                          const float (&offset)[3]) {
  at_ = At::kDone;
  DrillFault fault = readSizes(modal, words);
  if (fault == DrillFault::kNone) fault = readRepeat(words);
  if (fault != DrillFault::kNone) return fault;
  r_ = r_word_ + (modal.relative ? initial_z_ : offset[2]);
  bottom_ = bottom_word_ + (modal.relative ? r_ : offset[2]);
  if (!(float(fabs(bottom_)) <= kMostZ && float(fabs(r_)) <= kMostZ)) return DrillFault::kTooFar;
  if (!(bottom_ <= r_)) return DrillFault::kUpward;
  const bool goes_back = !modal.retracts_to_r && initial_z_ > r_;
  clear_z_ = goes_back ? initial_z_ : r_;
  x_ = words.has('X') ? modal.targetOf(from[0], words.value('X'), offset[0]) : from[0];
  y_ = words.has('Y') ? modal.targetOf(from[1], words.value('Y'), offset[1]) : from[1];
  step_x_ = modal.relative ? x_ - from[0] : 0;
  step_y_ = modal.relative ? y_ - from[1] : 0;
  cycle_ = modal.motion;
  z_ = from[2];
  at_ = At::kStart;
  return DrillFault::kNone;
}

bool Drilling::moveZ(DrillStep& step, DrillStep::Kind kind, float z, At then) {
  at_ = then;
  if (z_ == z) return false;
  z_ = z;
  step = {kind, x_, y_, z};
  return true;
}

void Drilling::goOn() {
  --holes_left_;
  x_ += step_x_;
  y_ += step_y_;
  at_ = holes_left_ != 0 ? At::kStart : At::kDone;
}

bool Drilling::next(DrillStep& step) {
  while (at_ != At::kDone)
    if (advance(step)) return true;
  return false;
}

bool Drilling::advance(DrillStep& step) {
  switch (at_) {
    case At::kStart:
      return moveZ(step, DrillStep::kRapid, z_ < r_ ? r_ : z_, At::kAcross);
    case At::kAcross:
      at_ = At::kAbove;
      step = {DrillStep::kAcross, x_, y_, z_};
      return true;
    case At::kAbove:
      depth_ = r_;
      return moveZ(step, DrillStep::kRapid, r_, At::kDown);
    case At::kDown:
      depth_ = cycle_ == kPeck && depth_ - peck_ > bottom_ ? depth_ - peck_ : bottom_;
      return moveZ(step, DrillStep::kFeed, depth_, depth_ > bottom_ ? At::kPecked : At::kBottom);
    case At::kPecked:
      return moveZ(step, DrillStep::kRapid, r_, At::kReturn);
    case At::kReturn:
      return moveZ(step, DrillStep::kRapid,
                   depth_ + kPeckClearance < r_ ? depth_ + kPeckClearance : r_, At::kDown);
    case At::kBottom:
      at_ = At::kUp;
      step = {DrillStep::kDwell, x_, y_, z_};
      return cycle_ == kDrillAndDwell;
    case At::kUp:
      return moveZ(step, DrillStep::kRapid, clear_z_, At::kOn);
    case At::kOn:
      goOn();
      return false;
    default:
      return false;
  }
}

}  // namespace gcode
