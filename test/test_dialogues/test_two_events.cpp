// Any two events at once, on the host's build of the firmware.
#include <gtest/gtest.h>

#include "machine/machine.h"
#include "settings_flash.h"
#include "two_events.h"

using namespace machine;
using namespace two_events;

namespace {

/// A machine on a stage, watched at every millisecond.
class Watched {
 public:
  Watched(std::vector<Step> steps, uint32_t seed) : stage_(std::move(steps)), law_(stage_) {
    stage_.letTicksFallAnywhere(seed);
    stage_.look = [this] {
      if (machine_ != nullptr) law_.look(seen());
    };
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
        return law_.broken();
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

  Seen seen() const {
    const Axes& axes = machine_->axes();
    Seen seen = {
        machine_->course().state(), axes.isPowered(), machine_->place().isTrusted(), {}, {}};
    for (const Axis axis : {kLeftAxis, kRightAxis, kZAxis}) {
      seen.targets[axis] = axes.target(axis);
      seen.lengths[axis] = axes.length(axis);
    }
    return seen;
  }

  Stage stage_;
  Law law_;
  Machine* machine_ = nullptr;
};

class TwoEvents : public testing::TestWithParam<int> {};

}  // namespace

TEST_P(TwoEvents, MoveNothingThatTheTableDoesNotSay) {
  const int first = GetParam();
  std::mt19937 random(17 + unsigned(first));
  for (int second = 0; second < kEventCount; ++second)
    for (int scene = 0; scene < kSceneCount; ++scene) {
      Watched watched(stepsOf(scene, first, second, random), random());
      EXPECT_EQ("", watched.play())
          << "scene " << scene << ": " << nameOf(first) << " then " << nameOf(second);
    }
}

INSTANTIATE_TEST_SUITE_P(All, TwoEvents, testing::Range(0, kEventCount));
