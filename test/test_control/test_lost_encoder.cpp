// A motor that is blocked or reversed, or whose encoder is: how far it runs before the watch says
// so.
#include <gtest/gtest.h>

#include <algorithm>

#include "axis.h"

using motion::Fault;

namespace {

/// When the encoder is lost.
enum class Lost { kAtRest, kOnTheWay, kBeforeTheFirstMove };

world::Wires unplugged() {
  world::Wires wires;
  wires.encoder_unplugged = true;
  return wires;
}

struct Case {
  double rate, feed;  // [Hz], [mm/min]
  Lost lost;
  world::Wires wires;
};

struct Run {
  Fault fault;
  double astray;  ///< [mm] largest distance of the chain from its set-point until the fault
};

/// Moves there and back at 800 mm/min, so that the watch learns the duty that the motor needs, and
/// rests.
void learn(ControlledAxis& axis, double rate) {
  ToAndFro way(800, axis.seconds);
  for (double goal : {20.0, 0.0})
    while (!way.isAt(goal)) axis.tick(way.towards(goal));
  for (int i = 0; i < int(1.5 * rate); ++i) axis.tick(0.0);
}

Run runOf(const Case& lost, unsigned seed, double goal) {
  ControlledAxis axis(seed, lost.rate);
  ToAndFro way(std::max(lost.feed, 1.0), axis.seconds);
  if (lost.lost != Lost::kBeforeTheFirstMove) learn(axis, lost.rate);
  if (lost.lost == Lost::kOnTheWay)
    for (int i = 0; i < int(lost.rate); ++i) axis.tick(way.towards(goal));
  axis.motor.wires = lost.wires;
  Run run = {Fault::kNone, 0};
  for (int i = 0; i < int(15 * lost.rate) && run.fault == Fault::kNone; ++i) {
    const Asked asked = lost.lost == Lost::kAtRest ? Asked{0, 0} : way.towards(goal);
    run.astray = std::max(run.astray, std::fabs(axis.tick(asked)));
    run.fault = axis.fault;
  }
  return run;
}

/// [mm] How far a motor that has lost its encoder on the way runs until it stands: braked from the
/// alarm on, which is a tick late, or without any power from the loss on.
double ranToStandstill(double rate, double feed, unsigned seed, double goal, bool is_cut_off) {
  ControlledAxis axis(seed, rate);
  ToAndFro way(feed, axis.seconds);
  learn(axis, rate);
  for (int i = 0; i < int(rate); ++i) axis.tick(way.towards(goal));
  const double begin = axis.motor.turns();
  axis.motor.wires = unplugged();
  axis.motor.is_powered = !is_cut_off;
  for (int i = 0; i < int(15 * rate) && axis.fault == Fault::kNone && !is_cut_off; ++i)
    axis.tick(way.towards(goal));
  axis.motor.is_powered = false;
  axis.motor.is_shorted = !is_cut_off;
  axis.motor.run(0, 4);
  return std::fabs(axis.motor.turns() - begin) * kTurnLength;
}

/// Forty motors in both directions, sorted by how far they ran; how many were never noticed.
std::vector<double> ranOf(const Case& lost, Fault expected, int& unseen) {
  std::vector<double> ran;
  unseen = 0;
  for (unsigned seed = 0; seed < kMotors; ++seed)
    for (const double goal : {60.0, -60.0}) {
      const Run run = runOf(lost, seed, goal);
      ran.push_back(run.astray);
      unseen += run.fault == Fault::kNone;
      EXPECT_TRUE(run.fault == expected || run.fault == Fault::kNone) << "motor " << seed;
    }
  std::sort(ran.begin(), ran.end());
  printf("%.0f Hz, %.0f mm/min: median %.2f mm, worst %.2f mm, unseen %d\n", lost.rate, lost.feed,
         ran[kMotors], ran.back(), unseen);
  return ran;
}

world::Wires withOneChannel() {
  world::Wires wires;
  wires.channel_lost = true;
  return wires;
}

class LostEncoder : public testing::TestWithParam<double> {};

}  // namespace

INSTANTIATE_TEST_SUITE_P(Both, LostEncoder, testing::Values(100.0, 200.0));

TEST_P(LostEncoder, IsNoticedOnTheWayWithinThreeMillimetres) {
  int unseen;
  for (const world::Wires& wires : {unplugged(), withOneChannel()})
    for (const double feed : {20.0, 60.0, 200.0, 800.0}) {
      EXPECT_LT(ranOf({GetParam(), feed, Lost::kOnTheWay, wires}, Fault::kStands, unseen).back(),
                2);
      EXPECT_EQ(0, unseen);
    }
}

TEST_P(LostEncoder, LetsItsMotorRunThreeMillimetresFartherThanAPowerCut) {
  for (const double feed : {20.0, 60.0, 200.0, 800.0, 1000.0}) {
    double worst = 0, farthest = 0;
    for (unsigned seed = 0; seed < kMotors; ++seed)
      for (const double goal : {60.0, -60.0}) {
        const double ran = ranToStandstill(GetParam(), feed, seed, goal, false);
        farthest = std::max(farthest, ran);
        worst = std::max(worst, ran - ranToStandstill(GetParam(), feed, seed, goal, true));
      }
    printf("%.0f Hz, %.0f mm/min: runs %.2f mm, %.2f mm more than a power cut\n", GetParam(), feed,
           farthest, worst);
    EXPECT_LT(worst, 3) << feed;
  }
}

TEST_P(LostEncoder, IsNoticedInTheFirstJogWithinThreeMillimetres) {
  int unseen;
  for (const world::Wires& wires : {unplugged(), withOneChannel()})
    for (const double feed : {20.0, 60.0, 200.0, 800.0}) {
      const Case lost = {GetParam(), feed, Lost::kBeforeTheFirstMove, wires};
      EXPECT_LT(ranOf(lost, Fault::kStands, unseen).back(), 3);
      EXPECT_EQ(0, unseen);
    }
}

TEST_P(LostEncoder, DoesNotLetAMotorAtRestRunAway) {
  // A motor that rests on its set-point stays there, so there is nothing to notice.
  int unseen;
  EXPECT_LT(ranOf({GetParam(), 0, Lost::kAtRest, unplugged()}, Fault::kStands, unseen).back(), 3);
  EXPECT_LT(ranOf({GetParam(), 0, Lost::kAtRest, withOneChannel()}, Fault::kStands, unseen).back(),
            4);
}

TEST_P(LostEncoder, InReverseIsNoticedWithinThreeMillimetresAndSoIsAMotorInReverse) {
  world::Wires encoder, motor;
  encoder.encoder_reversed = motor.motor_reversed = true;
  int unseen;
  for (const double feed : {20.0, 60.0, 200.0, 800.0}) {
    const Case lost = {GetParam(), feed, Lost::kBeforeTheFirstMove, encoder};
    EXPECT_LT(ranOf(lost, Fault::kTurnsBack, unseen).back(), 2.5);
    EXPECT_EQ(0, unseen);
  }
  EXPECT_LT(
      ranOf({GetParam(), 800, Lost::kBeforeTheFirstMove, motor}, Fault::kTurnsBack, unseen).back(),
      3);
  EXPECT_EQ(0, unseen);
}

TEST_P(LostEncoder, OfABlockedMotorIsToldToStand) {
  world::Wires blocked;
  blocked.blocked = true;
  int unseen;
  EXPECT_LT(ranOf({GetParam(), 800, Lost::kOnTheWay, blocked}, Fault::kStands, unseen).back(), 4);
  EXPECT_EQ(0, unseen);
}
