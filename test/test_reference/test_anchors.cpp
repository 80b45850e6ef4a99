// The judge against published figures for the default machine.
#include <gtest/gtest.h>

#include <algorithm>

#include "machines.h"

using Eigen::Vector2d;
using reference::Machine;

namespace {

TEST(Anchors, LengthsBeyondStraightLinesSpanThePublishedRange) {
  double least = 1e9, most = -1e9, slackest = 1e9, tightest = 0;
  for (const Vector2d& bit : gridOver(49, 25)) {
    const reference::Hang hang = reference::hangAt(defaultMachine(), bit);
    const Vector2d beyond = hang.paid_out - lengthsOf(Machine(), bit);
    least = std::min(least, beyond.minCoeff());
    most = std::max(most, beyond.maxCoeff());
    for (const reference::ChainForm* form : {&hang.left, &hang.right}) {
      slackest = std::min(slackest, form->tension_at_sprocket);
      tightest = std::max(tightest, form->tension_at_sprocket);
    }
  }
  // That solver also stretched the chain on the teeth, by up to 0.008 mm.
  EXPECT_NEAR(-1.38, least, 0.013);
  EXPECT_NEAR(6.18, most, 0.013);
  EXPECT_NEAR(18.0, slackest, 0.06);
  EXPECT_NEAR(165.2, tightest, 0.1);
}

}  // namespace
