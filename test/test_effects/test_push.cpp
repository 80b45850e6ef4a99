// A push on the sled: chains as the judge's pushed sled needs them, and effects that push.
#include <gtest/gtest.h>

#include "hidden.h"

using namespace kinematics;

namespace {

/// A hose that pulls the sled to its anchor, `kHeight` above the sheet's middle, with some force.
template <class Real>
struct Hose : Effect<Real> {
  enum { kForce, kParamCount };
  enum { kPull, kCoefficientCount };
  enum { kNeedsForces = 1, kPushesSled = 1 };
  enum { kHeight = 2000 };

  static void prepare(const Frame<Real>& frame, const Real* parameter, Real* c) {
    c[kPull] = parameter[kForce] / frame.sled_weight;
  }
  static void pushSled(const Real* c, Point<Real> bit, Point<Real>& push) {
    const Real across = -bit.x, up = Real(kHeight) - bit.y;
    const Real scale = c[kPull] / sqrt(across * across + up * up);
    push.x += across * scale;
    push.y += up * scale;
  }
};

const Point<double> kPushes[] = {{12, 0}, {-12, 0}, {0, 15}, {0, -15}, {8, -6}};  // [N]

// [N] A chain that pulls less is useless (see reach.h), and sags too deep for lib/Kinematics.
const double kLeastTension = 18;

/// Worst difference [mm] of the chains of a pushed sled from the judge's, over the usable sheet.
double worstPushed(const EffectParams<double>& effects, const Point<double>& push) {
  const Machine<double> laws = prepare(frameUnder({}), effects);
  reference::Machine machine = judge(effects);
  machine.push = {push.x, push.y};
  double worst = 0;
  for (const Eigen::Vector2d& place : sheetPlaces()) {
    const reference::Hang truth = reference::hangAt(machine, place);
    if (!truth.solved) return 1e9;
    if (fmin(truth.left.tension_at_sprocket, truth.right.tension_at_sprocket) < kLeastTension)
      continue;
    const Hanging<double> hanging = hangPushed(laws, Point<double>{place.x(), place.y()},
                                               {push.x / kSledWeight, push.y / kSledWeight});
    worst = fmax(worst, worse(paidOut(hanging), truth.paid_out));
  }
  return worst;
}

}  // namespace

TEST(Push, ChainsAreThoseOfTheJudgesPushedSled) {
  for (const Point<double>& push : kPushes) {
    EXPECT_LT(worstPushed(usualChain(), push), 0.006) << push.x << " " << push.y;
    EXPECT_LT(worstPushed(hiddenBy("", {{110, 0.007}, {111, 0.02}}, 0, 0).effects, push), 0.008);
    EXPECT_LT(worstPushed(hiddenBy("", {{120, 3}, {121, -2}}, 0, 0).effects, push), 0.012);
  }
}

TEST(Push, ListsKnowWhichEffectsPush) {
  typedef Registry<At<100, MotorLevel>, At<110, Hose>, At<120, Hose>>::For<double> Pushing;
  EXPECT_EQ(6, int(Pushing::kPushMask));
  const double parameter[] = {4, 10, 5};
  double c[Pushing::kCoefficientCount];
  Pushing::prepare(frameUnder({}), parameter, c);
  Point<double> push = {0, 0};
  Pushing::pushSled(c, Pushing::presentMask(parameter), {0, 0}, push);
  EXPECT_DOUBLE_EQ(15 / kSledWeight, push.y);
  Pushing::pushSled(c, 2, {2000, 2000}, push);
  EXPECT_DOUBLE_EQ(-10 / kSledWeight, push.x);
}
