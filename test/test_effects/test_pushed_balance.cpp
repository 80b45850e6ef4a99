// Pulls of both chains hold the sled against its load and any push.
#include <gtest/gtest.h>

#include "hidden.h"

using namespace kinematics;

TEST(PushedBalance, PullsHoldTheLoadAndThePush) {
  const Machine<double> laws = lawsWith({});
  for (const Eigen::Vector2d& at : sheetPlaces()) {
    const Point<double> place = {at.x(), at.y()};
    const Hanging<double> free = hangPushed(laws, place, {0, 0});
    const double load = free.strand[kLeft].pull * free.strand[kLeft].sine +
                        free.strand[kRight].pull * free.strand[kRight].sine;
    EXPECT_NEAR(load, 1, 0.05) << "the sled's weight, and a little chain";
    for (const Point<double>& push :
         {Point<double>{0, 0}, {0.1, 0}, {-0.1, 0}, {0, 0.15}, {0, -0.15}, {0.05, -0.1}}) {
      const Hanging<double> hanging = hangPushed(laws, place, push);
      const Strand<double>& left = hanging.strand[kLeft];
      const Strand<double>& right = hanging.strand[kRight];
      EXPECT_NEAR(left.pull * left.cosine - right.pull * right.cosine, push.x, 1e-9)
          << place.x << " " << place.y << ", push " << push.x << " " << push.y;
      EXPECT_NEAR(left.pull * left.sine + right.pull * right.sine, load - push.y, 1e-9)
          << place.x << " " << place.y << ", push " << push.x << " " << push.y;
      for (const Strand<double>& strand : hanging.strand) {
        EXPECT_NEAR(strand.slack * strand.pull, 1, 1e-9);
        EXPECT_NEAR(strand.bend * strand.pull, strand.cosine, 1e-9);
      }
    }
  }
}

TEST(PushedBalance, AFrameThatGivesFollowsThePullOfEachSide) {
  const Point<double> push = {14, -4};  // [N]
  for (const EffectParams<double>& effects :
       {hiddenBy("", {{110, 0.02}, {111, 0.02}}, 0, 0).effects,
        hiddenBy("", {{120, 6}, {121, -4}}, 0, 0).effects}) {
    const Machine<double> laws = prepare(frameUnder({}), effects);
    reference::Machine machine = judge(effects);
    machine.push = {push.x, push.y};
    for (const Eigen::Vector2d& place :
         {Eigen::Vector2d(-700, 300), Eigen::Vector2d(0, -300), Eigen::Vector2d(800, 100)}) {
      const reference::Hang truth = reference::hangAt(machine, place);
      ASSERT_TRUE(truth.solved);
      const Hanging<double> hanging = hangPushed(laws, Point<double>{place.x(), place.y()},
                                                 {push.x / kSledWeight, push.y / kSledWeight});
      EXPECT_LT(worse(paidOut(hanging), truth.paid_out), 0.015) << place.x() << " " << place.y();
    }
  }
}

TEST(Found, SaysWhetherASearchWasSentBeyondWhatHangs) {
  const Machine<double> laws = lawsWith({});
  const PaidOut<double> paid = inverse(laws, Point<double>{300, -200});
  EXPECT_EQ(Found::kYes, forward(laws, paid.chains, Point<double>{0, 0}).found);
  // Pulls so unequal that the sled would hang outside a motor.
  EXPECT_EQ(Found::kOutOfReach,
            forward(laws, Chains<double>{200, 3400}, Point<double>{0, 0}).found);
  EXPECT_EQ(Found::kOutOfReach, forward(laws, Chains<double>{1000, 1000}).found) << "too short";
}
