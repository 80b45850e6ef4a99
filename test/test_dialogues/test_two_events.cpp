// Any two events at once, on the host's build of the firmware.
#include <gtest/gtest.h>

#include "host_machine.h"
#include "machine/machine.h"
#include "two_events.h"

using namespace machine;
using namespace two_events;

namespace {

/// What is watched.
Seen seenOf(const Machine& machine) {
  const Axes& axes = machine.parts().axes;
  Seen seen = {
      machine.parts().course.state(), axes.isPowered(), machine.parts().keeper.trustsAll(), {}, {}};
  for (const Axis axis : {kLeftAxis, kRightAxis, kZAxis}) {
    seen.targets[axis] = axes.target(axis);
    seen.lengths[axis] = axes.length(axis);
  }
  return seen;
}

/// Plays to the end, watched at every millisecond; what broke the law, or nothing.
std::string play(std::vector<Step> steps, uint32_t seed) {
  HostMachine host(std::move(steps));
  host.brain.letTicksFallAnywhere(seed);
  Law law(host.player, host.world);
  host.player.look = [&] {
    if (host.brain.machine() != nullptr) law.look(seenOf(*host.brain.machine()));
  };
  const std::string failure = host.play();
  return failure.empty() ? law.broken() : failure;
}

class TwoEvents : public testing::TestWithParam<int> {};

}  // namespace

TEST_P(TwoEvents, MoveOnlyWhatTheTableSays) {
  const int first = GetParam();
  std::mt19937 random(17 + unsigned(first));
  for (int second = 0; second < kEventCount; ++second)
    for (int scene = 0; scene < kSceneCount; ++scene) {
      const std::vector<Step> steps = stepsOf(scene, first, second, random);
      EXPECT_EQ("", play(steps, random()))
          << "scene " << scene << ": " << nameOf(first) << " then " << nameOf(second);
    }
}

INSTANTIATE_TEST_SUITE_P(All, TwoEvents, testing::Range(0, kEventCount));
