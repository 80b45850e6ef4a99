// The judge against figures that others published for the default machine.
#include <gtest/gtest.h>

#include <algorithm>

#include "machines.h"

using Eigen::Vector2d;
using reference::Machine;

namespace {

/// [mm] By how much a machine misses `bit` when its chains are those of a straight and rigid
/// machine.
Vector2d fieldAt(const Machine& truth, const Vector2d& bit) {
  return reference::settle(truth, lengthsOf(Machine(), bit), bit).bit - bit;
}

void expectField(const Machine& truth, const Vector2d& bit, const Vector2d& published,
                 double within) {
  const Vector2d field = fieldAt(truth, bit);
  EXPECT_NEAR(published.x(), field.x(), within) << bit.transpose();
  EXPECT_NEAR(published.y(), field.y(), within) << bit.transpose();
}

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

TEST(Anchors, SagInTheLowerCornerIsThePublishedOne) {
  // Published for chains that run to the bit itself.
  Machine bare;
  bare.rotation_radius = 0;
  const Machine heavy = withChains(bare, 0.00137293, 0);
  const auto sag = [&](const Vector2d& bit) {
    return (lengthsOf(heavy, bit) - lengthsOf(bare, bit))[0];
  };
  EXPECT_NEAR(3.68, sag({1150, -550}), 0.006);
  EXPECT_NEAR(5.515, sag({1200, -600}), 0.011);
}

TEST(Anchors, SagMovesTheSledAsPublished) {
  const Machine machine = withChains(Machine(), 0.00137293, 0);
  expectField(machine, {0, 550}, {0, 0.04}, 0.02);
  expectField(machine, {1150, 0}, {-1.68, 0.52}, 0.05);
  expectField(machine, {1150, -550}, {-3.74, 0.76}, 0.1);
}

TEST(Anchors, StretchMovesTheSledAsPublished) {
  const Machine machine = withChains(Machine(), 0, 5.17e-6);
  // The published chain stretches on its arm, too: up to 8 % more.
  expectField(machine, {1150, 0}, {0.21, -0.62}, 0.08);
  expectField(machine, {0, 0}, {0, -1.34}, 0.13);
  EXPECT_NEAR(-3.48, fieldAt(machine, {0, 550}).y(), 0.35);
}

TEST(Anchors, SledGivesToAPushAsPublished) {
  const auto give = [](const Vector2d& bit) {
    const Machine still = defaultMachine();
    Machine pushed = still;
    pushed.push = {0.1, 0};
    return 10 * (reference::settle(pushed, lengthsOf(still, bit), bit).bit - bit).x();
  };
  EXPECT_NEAR(0.12, give({1150, 0}), 0.01);
  EXPECT_NEAR(0.39, give({1150, -550}), 0.02);
  EXPECT_NEAR(0.69, give({1200, -600}), 0.04);
}

TEST(Anchors, SprocketsOffTheSheetMoveTheSledAsPublished) {
  Machine machine;
  machine.plane_gap = 50;
  // The published chains run up to the bit, so they are longer by the arm.
  machine.rotation_radius = 0;
  Machine flat = machine;
  flat.plane_gap = 0;
  const auto rise = [&](const Vector2d& bit) {
    return reference::settle(machine, lengthsOf(flat, bit), bit).bit.y() - bit.y();
  };
  EXPECT_NEAR(2.35, rise({0, 550}), 0.02);
  EXPECT_NEAR(1.16, rise({0, 0}), 0.02);
  EXPECT_NEAR(0.77, rise({0, -550}), 0.02);
}

TEST(Anchors, MountsThatGiveMoveTheSledAsPublished) {
  Machine inwards;
  inwards.left.inward = inwards.right.inward = 1.0 / 140;
  expectField(inwards, {0, 550}, {0, -2.70}, 0.15);
  expectField(inwards, {1150, 0}, {0.15, -0.10}, 0.02);
  Machine downwards;
  downwards.left.downward = downwards.right.downward = 2 / 97.9;
  expectField(downwards, {0, 0}, {0, -1.00}, 0.02);
  expectField(downwards, {1150, -550}, {-0.85, -1.60}, 0.03);
}

TEST(Anchors, LeaningFrameAddsATenthOfTheSag) {
  Machine bare;
  bare.rotation_radius = 0;
  Machine upright = withChains(bare, 0.00137293, 0), leaning = upright;
  leaning.lean = 15 * M_PI / 180;
  const Vector2d bit(1150, -550);
  const double sag = (lengthsOf(upright, bit) - lengthsOf(bare, bit))[0];
  const double more = (lengthsOf(leaning, bit) - lengthsOf(upright, bit))[0];
  EXPECT_NEAR(0.10, more / sag, 0.02);
}

}  // namespace
