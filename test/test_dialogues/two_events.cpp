// Scenes, events, and the look at a machine.
#include "two_events.h"

#include <algorithm>
#include <cmath>

using namespace machine;

namespace two_events {
namespace {

const long kBrakingMs = 400;     // from 15 mm/s at 100 mm/s^2, and z from 1 mm/s at 10 mm/s^2
const long kReleasingMs = 1;     // a look may fall between the alarm and the release behind it
const double kMostOff = 0.3;     // [mm]
const double kMostUnseen = 3.2;  // [mm] that a motor runs without its encoder: lost_encoder.nc
const char kHoldStep[] = "^H";

const Step kEvents[] = {
    {Step::kSendRaw, kHoldStep, ""}, {Step::kSendRaw, "~", ""},
    {Step::kSendRaw, "!", ""},       {Step::kSendRaw, "^X", ""},
    {Step::kSendRaw, "^1", ""},      {Step::kSendRaw, "^2", ""},
    {Step::kSend, "G0 Z2", ""},      {Step::kSend, "G1 X-20 Y10 F900", ""},
    {Step::kAsk, "power cut", ""},   {Step::kAsk, "unplug left", ""},
    {Step::kSendRaw, "?^J", ""},     {Step::kSend, "$J=G91 X-40 F900", ""},
    {Step::kSend, "B15", ""},        {Step::kSend, "$C", ""},
    {Step::kSend, "$$", ""},
};

/// What the machine does before both events.
const std::vector<Step> kScenes[] = {
    {{Step::kSend, "G1 X60 F900", ""}, {Step::kSend, "X60 Y40 Z-2", ""}, {Step::kSend, "M0", ""}},
    {{Step::kSend, "M0", ""}, {Step::kAsk, "wait 0.5", ""}, {Step::kSend, "G0 Z3", ""}},
    {{Step::kSend, "T2 M6", ""},
     {Step::kSend, "G1 X30 F900", ""},
     {Step::kAsk, "wait 0.5", ""},
     {Step::kSend, "G0 Z2", ""},
     {Step::kAsk, "wait 5", ""},
     {Step::kSendRaw, "~", ""}},
    {{Step::kSend, "G1 X60 F900", ""},
     {Step::kAsk, "wait 1", ""},
     {Step::kSendRaw, kHoldStep, ""},
     {Step::kAsk, "wait 0.5", ""},
     {Step::kSend, "G0 Z2", ""}},
    {{Step::kSend, "G1 X60 F900", ""},
     {Step::kAsk, "wait 1", ""},
     {Step::kSendRaw, kHoldStep, ""},
     {Step::kAsk, "wait 0.5", ""},
     {Step::kSend, "G0 Z2", ""},
     {Step::kAsk, "wait 5", ""},
     {Step::kSendRaw, "~", ""}},
    {{Step::kSend, "G4 P2000", ""}, {Step::kSend, "G1 X30 F900", ""}, {Step::kSend, "M0", ""}},
    {{Step::kSend, "G1 X60 F900", ""}, {Step::kSend, "G33 X5", ""}},
    {{Step::kSendRaw, "?", ""},
     {Step::kSend, "$J=G91 X60 F900", ""},
     {Step::kSend, "$J=G91 Y40 Z-2 F900", ""}},
};

}  // namespace

const int kEventCount = sizeof kEvents / sizeof *kEvents;
const int kSceneCount = sizeof kScenes / sizeof *kScenes;

std::string nameOf(int event) { return kEvents[event].text; }

std::vector<Step> stepsOf(int scene, int first, int second, std::mt19937& random) {
  std::vector<Step> steps = readScript("test/dialogues", "setup.inc");
  steps.insert(steps.end(), kScenes[scene].begin(), kScenes[scene].end());
  const auto wait = [&](double most, const std::string& place) {
    const double seconds = std::uniform_real_distribution<double>(0, most)(random);
    steps.push_back({Step::kAsk, "wait " + std::to_string(seconds), place});
  };
  wait(3, "before both");
  steps.push_back(kEvents[first]);
  wait(random() % 3 == 0 ? 0.01 : 1.2, std::string("after ") + kEvents[first].text);
  steps.push_back(kEvents[second]);
  // A third event is drawn.
  wait(random() % 3 == 0 ? 0.01 : 1.2, std::string("after ") + kEvents[second].text);
  const Step& third = kEvents[random() % unsigned(kEventCount)];
  steps.push_back(third);
  steps.push_back({Step::kAsk, "wait 2", std::string("after ") + third.text});
  for (const char* text : {"plug left", "wait 1"}) steps.push_back({Step::kAsk, text, "last"});
  steps.push_back({Step::kSendRaw, "!", "last"});
  steps.push_back({Step::kAsk, "wait 3", "last"});
  steps.push_back({Step::kAsk, "answers from now", "last"});
  steps.push_back({Step::kAsk, "wait 0.1", "the end"});
  return steps;
}

void Law::look(const Seen& seen) {
  const State state = seen.state;
  const std::string step = player_.whereInTheScript();
  if (state != state_ || step != step_) unchanged_ms_ = 0;
  if (state == State::kLowering || state == State::kResuming) has_jogged_ = false;
  if (step != step_) has_jogged_ = step.find(kHoldStep) != std::string::npos ? false : true;
  if (world_.wires(world::kLeft).encoder_unplugged) is_encoder_lost_ = true;
  state_ = state;
  step_ = step;
  if (++unchanged_ms_ > kBrakingMs) checkStill(seen);
  const bool has_failed = state == State::kFalling || state == State::kAlarm;
  powered_ms_ = has_failed && seen.is_powered ? powered_ms_ + 1 : 0;
  if (powered_ms_ > kReleasingMs) breaks("a motor has power in an alarm");
  std::copy(seen.targets, seen.targets + kAxisCount, were_);
  if (step.find("the end") != std::string::npos) checkPlace(seen);
}

void Law::checkStill(const Seen& seen) {
  // A motor without power is followed, not moved.
  if (Course::pathGoesIn(state_) || !seen.is_powered) return;
  ++times_still_;
  const bool z_may = state_ == State::kLowering || has_jogged_;
  for (int i = 0; i < (z_may ? kZAxis : kAxisCount); ++i)
    if (seen.targets[i] != were_[i]) breaks("axis " + std::to_string(i) + " moves");
}

void Law::checkPlace(const Seen& seen) {
  if (!seen.is_trusted) return;
  ++times_place_;
  const double most = is_encoder_lost_ ? kMostUnseen : kMostOff;
  for (const Axis axis : {kLeftAxis, kRightAxis, kZAxis}) {
    const double off = double(seen.lengths[axis]) - world_.travel(world::Axis(axis));
    if (!(std::fabs(off) <= most))
      breaks("axis " + std::to_string(axis) + " is elsewhere by " + std::to_string(off));
  }
}

void Law::breaks(const std::string& what) {
  if (broken_.empty()) broken_ = what + " in state " + std::to_string(int(state_)) + " at " + step_;
}

}  // namespace two_events
