// Z is slow: nothing crosses the sheet, and no hole ends, before z has come to its height.
#include <gtest/gtest.h>

#include <algorithm>

#include "host_machine.h"

namespace {

const double kNear = 0.08;  // [mm]

/// Heights of the bit [mm].
struct Heights {
  double lowest = 9;                              ///< of all
  double lowest_across = 9, highest_across = -9;  ///< while the sled crosses the sheet
};

/// Does lines on a machine with motors drawn by `seed`; what the bit did after the first of them.
Heights cut(const std::vector<std::string>& lines, unsigned seed) {
  std::vector<Step> steps = readScript("test/dialogues", "setup.inc");
  std::vector<std::string> all = {"$18=18"};  // as the z axis is sold
  all.insert(all.end(), lines.begin(), lines.end());
  for (const std::string& line : all) {
    steps.push_back({Step::kSend, line, line});
    steps.push_back({Step::kExpect, "ok", line});
  }
  steps.push_back({Step::kSend, "G4 P0", "dwell"});
  steps.push_back({Step::kSkipTo, "ok", "dwell"});
  HostMachine host(steps, 1651, {2, "", machine::Start::kUsual}, seed);
  Heights heights;
  double before = host.world.travel(world::kLeft);
  host.player.look = [&] {
    const double kCrosses = 0.002, kJumps = 1;  // [mm/ms] the sled moves, or is hung elsewhere
    const double left = host.world.travel(world::kLeft), z = host.world.travel(world::kZ);
    heights.lowest = std::min(heights.lowest, z);
    const double went = std::fabs(left - before);
    if (went > kCrosses && went < kJumps) {
      heights.lowest_across = std::min(heights.lowest_across, z);
      heights.highest_across = std::max(heights.highest_across, z);
    }
    before = left;
  };
  EXPECT_EQ("", host.play()) << seed;
  return heights;
}

class ZInTime : public testing::TestWithParam<unsigned> {};

}  // namespace

TEST_P(ZInTime, IsAtTheBottomBeforeAHoleEnds) {
  EXPECT_NEAR(-6, cut({"G81 X0 Y0 Z-6 R0 F90"}, GetParam()).lowest, kNear);
}

TEST_P(ZInTime, IsAtItsDepthBeforeTheSledCrosses) {
  EXPECT_NEAR(-3, cut({"G1 Z-3 F60", "G1 X30 F1000"}, GetParam()).highest_across, kNear);
}

TEST_P(ZInTime, IsOutOfTheWorkBeforeTheSledCrosses) {
  EXPECT_NEAR(0.5, cut({"G1 Z-2 F60", "G0 Z0.5", "G0 X30"}, GetParam()).lowest_across, kNear);
}

INSTANTIATE_TEST_SUITE_P(Motors, ZInTime, testing::Range(0u, 16u));
