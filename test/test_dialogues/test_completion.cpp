// With any overrides and holds a program reaches its last place, z included, and each of its lines
// is answered once.
#include <gtest/gtest.h>

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
