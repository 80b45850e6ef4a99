// Two events at once: whatever comes together, nothing moves that the table of states does not say,
// and afterwards the place is true or unknown.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "machine/machine.h"
#include "settings_flash.h"
#include "stage.h"

using namespace machine;

namespace {

const long kBrakingMs = 400;  // from 15 mm/s at 100 mm/s^2, and z from 1 mm/s at 10 mm/s^2
const double kMostOff = 0.3;  // [mm]
const char kHoldStep[] = "^H";

const Step kEvents[] = {
    {Step::kSendRaw, kHoldStep, ""}, {Step::kSendRaw, "~", ""},
    {Step::kSendRaw, "!", ""},       {Step::kSendRaw, "^X", ""},
    {Step::kSendRaw, "^1", ""},      {Step::kSendRaw, "^2", ""},
    {Step::kSend, "G0 Z2", ""},      {Step::kSend, "G1 X-20 Y10 F900", ""},
    {Step::kAsk, "power cut", ""},   {Step::kAsk, "unplug left", ""},
};
const int kEventCount = sizeof kEvents / sizeof *kEvents;

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
};
const int kSceneCount = sizeof kScenes / sizeof *kScenes;

/// A machine on a stage, watched at every millisecond.
class Watched {
 public:
  Watched(std::vector<Step> steps, uint32_t seed) : stage_(std::move(steps)) {
    stage_.letTicksFallAnywhere(seed);
    stage_.look = [this] { look(); };
  }

  /// Plays to the end; what broke the law, or nothing.
  std::string play() {
    for (;;) {
      try {
        live();
      } catch (const PowerGone&) {
        machine_ = nullptr;
        stage_.tick = [] {};
        stage_.restart();
      } catch (const TheEnd&) {
        return broken_;
      } catch (const Failure& failure) {
        return failure.what();
      }
    }
  }

 private:
  void live() {
    const FlashTable table;
    Machine machine({stage_, stage_, stage_, stage_, stage_.eeprom, table}, {2, ""});
    machine_ = &machine;
    stage_.tick = [&] { machine.tick(); };
    machine.begin();
    for (;;) machine.loop();
  }

  void look() {
    if (machine_ == nullptr) return;
    const Axes& axes = machine_->axes();
    const State state = machine_->course().state();
    const std::string step = stage_.whereInTheScript();
    if (state != state_ || step != step_) unchanged_ms_ = 0;
    if (state == State::kLowering || state == State::kResuming) has_jogged_ = false;
    if (step != step_) has_jogged_ = step.find(kHoldStep) != std::string::npos ? false : true;
    state_ = state;
    step_ = step;
    float targets[kAxisCount];
    for (int i = 0; i < kAxisCount; ++i) targets[i] = axes.target(Axis(i));
    if (++unchanged_ms_ > kBrakingMs) checkStill(targets);
    const bool has_failed = state == State::kFalling || state == State::kAlarm;
    if (has_failed && axes.isPowered()) breaks("a motor has power in an alarm");
    std::copy(targets, targets + kAxisCount, were_);
    if (step.find("the end") != std::string::npos) checkPlace();
  }

  void checkStill(const float* targets) {
    // A motor without power is followed, not moved.
    if (Course::pathGoesIn(state_) || !machine_->axes().isPowered()) return;
    const bool z_may = state_ == State::kLowering || has_jogged_;
    for (int i = 0; i < (z_may ? kZAxis : kAxisCount); ++i)
      if (targets[i] != were_[i]) breaks("axis " + std::to_string(i) + " moves");
  }

  void checkPlace() {
    if (!machine_->place().isTrusted()) return;
    for (const Axis axis : {kLeftAxis, kRightAxis, kZAxis}) {
      const double off = double(machine_->axes().length(axis)) - stage_.motor(axis).travel;
      if (std::fabs(off) > kMostOff) breaks("axis " + std::to_string(axis) + " is elsewhere");
    }
  }

  void breaks(const std::string& what) {
    if (broken_.empty())
      broken_ = what + " in state " + std::to_string(int(state_)) + " at " + step_;
  }

  Stage stage_;
  Machine* machine_ = nullptr;
  State state_ = State::kRunning;
  std::string step_, broken_;
  long unchanged_ms_ = 0;
  bool has_jogged_ = true;  ///< a line for z may have come since the last hold
  float were_[kAxisCount] = {0, 0, 0};
};

/// A scene, both events at drawn moments, and an end at which the machine is asked where it is.
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
  steps.push_back({Step::kAsk, "wait 2", std::string("after ") + kEvents[second].text});
  for (const char* text : {"plug left", "wait 1"}) steps.push_back({Step::kAsk, text, "last"});
  steps.push_back({Step::kSendRaw, "!", "last"});
  steps.push_back({Step::kAsk, "wait 3", "last"});
  steps.push_back({Step::kAsk, "answers from now", "last"});
  steps.push_back({Step::kAsk, "wait 0.1", "the end"});
  return steps;
}

class TwoEvents : public testing::TestWithParam<int> {};

}  // namespace

TEST_P(TwoEvents, MoveNothingThatTheTableDoesNotSay) {
  const int first = GetParam();
  std::mt19937 random(17 + unsigned(first));
  for (int second = 0; second < kEventCount; ++second)
    for (int scene = 0; scene < kSceneCount; ++scene) {
      Watched watched(stepsOf(scene, first, second, random), random());
      EXPECT_EQ("", watched.play())
          << "scene " << scene << ": " << kEvents[first].text << " then " << kEvents[second].text;
    }
}

INSTANTIATE_TEST_SUITE_P(All, TwoEvents, testing::Range(0, kEventCount));
