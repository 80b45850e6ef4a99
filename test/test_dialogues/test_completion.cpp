// With any overrides and holds a program reaches its last place, z in time included, and each of
// its lines is answered once.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "host_machine.h"

namespace {

/// A program of random moves with random overrides and holds.
class Drawn {
 public:
  explicit Drawn(unsigned seed) : random_(seed), is_grbl_(seed % 2 == 1) {}

  std::vector<Step> steps() {
    push(Step::kSend, "$18=18");
    push(Step::kExpect, "ok");
    if (is_grbl_) push(Step::kSendRaw, "?");
    if (is_grbl_) push(Step::kSkipTo, "$131=1219.2");
    push(Step::kAsk, "answers from now");
    const int kLines = 14;
    for (int line = 0; line < kLines; ++line) {
      push(Step::kSend, move());
      meddle();
      push(Step::kSkipTo, "ok");
    }
    push(Step::kSend, "G4 P0");
    push(Step::kSkipTo, "ok");
    push(Step::kAsk, "answers " + std::to_string(kLines + 1));
    push(Step::kAsk, "wait 1");
    push(Step::kAsk, "sled X" + std::to_string(x_) + " Y" + std::to_string(y_) + " within 0.06");
    push(Step::kAsk, "z " + std::to_string(z_) + " within 0.05");
    return steps_;
  }

 private:
  int draw(int most) { return int(random_() % unsigned(most)); }
  void push(Step::Kind kind, const std::string& text) { steps_.push_back({kind, text, text}); }

  /// A line for z, across the sheet, or both.
  std::string move() {
    const int kind = draw(3);
    std::string line = draw(2) ? "G0" : "G1 F" + std::to_string(60 + 20 * draw(40));
    if (kind != 0)
      line += " X" + std::to_string(x_ = draw(60)) + " Y" + std::to_string(y_ = draw(60));
    if (kind != 1) line += " Z" + std::to_string(z_ = draw(5) - 3);
    return line;
  }

  void meddle() {
    const std::string overrides[] = {"^0",         "^1", "^2", "^2^2^2", "^4",
                                     "^4^4^4^4^4", "^5", "^6", "^7"};
    if (draw(2)) push(Step::kSendRaw, overrides[draw(9)]);
    if (draw(4) != 0) return;
    push(Step::kAsk, "wait 0." + std::to_string(1 + draw(9)));
    push(Step::kSendRaw, is_grbl_ ? "!" : "^H");
    push(Step::kAsk, "wait 0." + std::to_string(1 + draw(9)));
    push(Step::kSendRaw, "~");
  }

  std::mt19937 random_;
  const bool is_grbl_;
  std::vector<Step> steps_ = readScript("test/dialogues", "setup.inc");
  int x_ = 0, y_ = 0, z_ = 0;
};

class Completion : public testing::TestWithParam<unsigned> {};

}  // namespace

TEST_P(Completion, OfARandomProgramWithOverridesAndHolds) {
  for (unsigned program = 0; program < 4; ++program) {
    const unsigned seed = 4 * GetParam() + program;
    HostMachine host(Drawn(seed).steps());
    host.brain.letTicksFallAnywhere(seed);
    EXPECT_EQ("", host.play()) << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, Completion, testing::Range(0u, 6u));

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
