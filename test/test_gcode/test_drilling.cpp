// Drilling cycles as lists of steps, against what RS274 says of them.
#include <gtest/gtest.h>

#include <cstdio>

#include "reading.h"

using namespace gcode;

namespace {

/// A program of drilling lines, and where the tool is.
class Driller {
 public:
  explicit Driller(float z) : at_{0, 0, z} {}

  float offset[3] = {0, 0, 0};
  Modal modal;

  /// All steps of a line: `across x y`, `rapid z`, `feed z`, `dwell`.
  std::string drill(const std::string& line) {
    const DrillFault fault = read(line);
    return fault == DrillFault::kNone ? allSteps() : "fault";
  }

  std::string allSteps() {
    std::string said;
    DrillStep step;
    while (drilling_.next(step)) said += (said.empty() ? "" : ", ") + take(step);
    return said;
  }

  DrillFault read(const std::string& line) {
    const bool was_drilling = modal.motion > kNoMotion;
    Words words;
    for (const Piece& piece : piecesOf(line)) {
      if (piece.tenths >= 810 && piece.tenths <= 830)
        modal.motion = uint8_t(piece.tenths / 10);
      else
        modal.take(piece.tenths);
      if (piece.words.hasPlace()) words = piece.words;
    }
    if (!was_drilling) drilling_.begin(at_[2]);
    return drilling_.read(modal, words, at_, offset);
  }

  uint32_t dwell() const { return drilling_.dwell(); }
  void goTo(float z) { at_[2] = z; }
  void endCycle() { modal.take(800); }

 private:
  std::string take(const DrillStep& step) {
    char text[40];
    switch (step.kind) {
      case DrillStep::kAcross:
        at_[0] = step.x, at_[1] = step.y;
        std::snprintf(text, sizeof text, "across %g %g", double(step.x), double(step.y));
        break;
      case DrillStep::kDwell:
        return "dwell";
      default:
        at_[2] = step.z;
        std::snprintf(text, sizeof text, step.kind == DrillStep::kFeed ? "feed %g" : "rapid %g",
                      double(step.z));
    }
    return text;
  }

  float at_[3];
  Drilling drilling_;
};

}  // namespace

TEST(Drilling, GoesAcrossDownAndBackToWhereZWas) {
  Driller tool(10);
  EXPECT_EQ("across 5 6, rapid 2, feed -3, rapid 10", tool.drill("G98 G81 X5 Y6 Z-3 R2"));
  EXPECT_EQ("across 7 6, rapid 2, feed -3, rapid 10", tool.drill("X7"));
  EXPECT_EQ("across 7 6, rapid 2, feed -4, rapid 10", tool.drill("Z-4"));
  EXPECT_EQ("across 7 9, rapid 3, feed -4, rapid 10", tool.drill("Y9 R3"));
}

TEST(Drilling, StaysAtRWithG99) {
  Driller tool(10);
  EXPECT_EQ("across 5 6, rapid 2, feed -3, rapid 2", tool.drill("G99 G81 X5 Y6 Z-3 R2"));
  EXPECT_EQ("across 7 6, feed -3, rapid 2", tool.drill("X7"));
  EXPECT_EQ("across 8 6, feed -3, rapid 10", tool.drill("G98 X8"));
}

TEST(Drilling, RisesToRBeforeItGoesAcross) {
  Driller tool(-1);
  EXPECT_EQ("rapid 2, across 5 0, feed -3, rapid 2", tool.drill("G98 G81 X5 Z-3 R2"));
}

TEST(Drilling, DwellsAtTheBottomWithG82) {
  Driller tool(5);
  EXPECT_EQ("across 1 0, rapid 1, feed -2, dwell, rapid 5", tool.drill("G82 X1 Z-2 R1 P250"));
  EXPECT_EQ(250u, tool.dwell());
  EXPECT_EQ("across 2 0, rapid 1, feed -2, dwell, rapid 5", tool.drill("X2"));
  EXPECT_EQ(250u, tool.dwell());
}

TEST(Drilling, PecksWithG83) {
  Driller tool(5);
  EXPECT_EQ(
      "across 1 0, rapid 1, feed -1, rapid 1, rapid -0.75, feed -3, rapid 1, rapid -2.75, feed -4, "
      "rapid 5",
      tool.drill("G83 X1 Z-4 R1 Q2"));
  EXPECT_EQ("across 2 0, rapid 1, feed -0.5, rapid 5", tool.drill("X2 Z-0.5"));
}

TEST(Drilling, NeverRapidsBelowTheLastPeck) {
  Driller tool(5);
  // A peck shorter than the clearance: the way back ends at R, not above it.
  EXPECT_EQ("across 1 0, rapid 1, feed 0.9, rapid 1, feed 0.8, rapid 5",
            tool.drill("G83 X1 Z0.8 R1 Q0.1"));
}

TEST(Drilling, RepeatsAlongTheMoveInG91) {
  Driller tool(5);
  EXPECT_EQ(
      "across 10 0, rapid 2, feed -1, rapid 5, across 20 0, rapid 2, feed -1, rapid 5, "
      "across 30 0, rapid 2, feed -1, rapid 5",
      tool.drill("G91 G81 X10 R-3 Z-3 L3"));
  EXPECT_EQ("across 30 1, rapid 2, feed -1, rapid 5, across 30 2, rapid 2, feed -1, rapid 5",
            tool.drill("Y1 L2"));
  // R counts from where z was before the cycle, even if z is lower now.
  EXPECT_EQ("across 40 2, rapid 2, feed -1, rapid 2", tool.drill("G99 X10"));
  EXPECT_EQ("across 50 2, feed -1, rapid 2", tool.drill("X10"));
}

TEST(Drilling, AddsTheWorkOffset) {
  Driller tool(20);
  tool.offset[0] = 100;
  tool.offset[1] = 50;
  tool.offset[2] = 10;
  EXPECT_EQ("across 101 52, rapid 13, feed 5, rapid 20", tool.drill("G81 X1 Y2 Z-5 R3"));
}

TEST(Drilling, ReadsInches) {
  Driller tool(50.8f);
  EXPECT_EQ("across 25.4 0, rapid 25.4, feed -25.4, rapid 50.8", tool.drill("G20 G81 X1 Z-1 R1"));
  EXPECT_EQ("across 50.8 0, rapid 25.4, feed 0, rapid 25.4, rapid 0.25, feed -12.7, rapid 50.8",
            tool.drill("G83 X2 Z-0.5 Q1"));
}

TEST(Drilling, SaysWhatIsMissing) {
  Driller tool(5);
  EXPECT_EQ(DrillFault::kNoDepth, tool.read("G81 X1 R1"));
  EXPECT_EQ(DrillFault::kNoDepth, Driller(5).read("G81 X1 Z-1"));
  EXPECT_EQ(DrillFault::kUpward, Driller(5).read("G81 X1 Z2 R1"));
  EXPECT_EQ(DrillFault::kTooFar, Driller(5).read("G81 X1 Z-1 R10001"));
  EXPECT_EQ(DrillFault::kTooFar, Driller(5).read("G81 X1 Z-10001 R1"));
  EXPECT_EQ(DrillFault::kNone, Driller(5).read("G81 X1 Z-10000 R10000"));
  EXPECT_EQ(DrillFault::kNoPeck, Driller(5).read("G83 X1 Z-1 R1"));
  EXPECT_EQ(DrillFault::kNoPeck, Driller(5).read("G83 X1 Z-1 R1 Q0"));
  EXPECT_EQ(DrillFault::kNoPeck, Driller(5).read("G83 X1 Z-1 R1 Q0.0099"));
  EXPECT_EQ(DrillFault::kNoPeck, Driller(5).read("G20 G83 X1 Z-1 R1 Q0.0003"));
  EXPECT_EQ(DrillFault::kNone, Driller(5).read("G83 X1 Z-1 R1 Q0.01"));
  EXPECT_EQ(DrillFault::kBadRepeat, Driller(5).read("G81 X1 Z-1 R1 L0"));
  EXPECT_EQ(DrillFault::kBadRepeat, Driller(5).read("G81 X1 Z-1 R1 L1.5"));
  EXPECT_EQ(DrillFault::kBadDwell, Driller(5).read("G82 X1 Z-1 R1 P-1"));
}

TEST(Drilling, PecksToTheBottomInTheSmallestPecks) {
  Driller tool(5);
  ASSERT_EQ(DrillFault::kNone, tool.read("G83 X0 Z-3 R5 Q0.01"));
  const std::string steps = tool.allSteps();
  EXPECT_EQ("feed -3", steps.substr(steps.rfind("feed"), 7));
}

TEST(Drilling, DrillsARepeatedHoleInOnePlaceOnlyOnce) {
  Driller tool(2);
  ASSERT_EQ(DrillFault::kNone, tool.read("G81 X3 Z2 R2 L999"));
  std::string all;
  for (int i = 0; i < 999; ++i) all += (i == 0 ? "" : ", ") + std::string("across 3 0");
  EXPECT_EQ(all, tool.allSteps());
}

TEST(Drilling, DropsTheStepsOfARefusedLine) {
  Driller tool(5);
  ASSERT_EQ(DrillFault::kNone, tool.read("G81 X1 Z-1 R1"));
  ASSERT_NE(DrillFault::kNone, tool.read("X2 L0"));
  EXPECT_EQ("", tool.allSteps());
}

TEST(Drilling, AcceptsAHoleWithoutDepth) {
  Driller tool(5);
  EXPECT_EQ("across 1 0, rapid 1, rapid 5", tool.drill("G81 X1 Z1 R1"));
}

TEST(Drilling, ForgetsItsSizesWhereTheCycleEnds) {
  Driller tool(5);
  EXPECT_EQ("across 1 0, rapid 1, feed -1, rapid 5", tool.drill("G81 X1 Z-1 R1"));
  tool.endCycle();
  tool.goTo(8);
  EXPECT_EQ("fault", tool.drill("G81 X2"));
  EXPECT_EQ("across 2 0, rapid 1, feed -1, rapid 8", tool.drill("X2 Z-1 R1"));
  EXPECT_NE("fault", tool.drill("G83 X3 Q1 P250"));
  tool.endCycle();
  EXPECT_EQ(DrillFault::kNoPeck, tool.read("G83 X2 Z-1 R1"));
  tool.endCycle();
  EXPECT_EQ(DrillFault::kNone, tool.read("G82 X2 Z-1 R1"));
  EXPECT_EQ(0u, tool.dwell());
}
