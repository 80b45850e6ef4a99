// Every effect against the mechanics of the judge, effects that push the sled, the pulls of both
// chains.
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

}  // namespace

TEST(Push, RegistryKnowsWhichEffectsPush) {
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

class AgainstJudge : public testing::TestWithParam<Hidden> {};
INSTANTIATE_TEST_SUITE_P(Effects, AgainstJudge, testing::ValuesIn(everyEffect()),
                         [](const testing::TestParamInfo<Hidden>& tested) {
                           return tested.param.name;
                         });

TEST_P(AgainstJudge, LengthsAgreeOverTheSheet) {
  const Machine<double> laws = prepare(frameUnder({}), GetParam().effects);
  EXPECT_LT(worstOver(laws, judge(GetParam().effects)), GetParam().allowed);
}

TEST_P(AgainstJudge, IsWellOffWithoutTheEffect) {
  const Machine<double> laws = prepare(frameUnder({}), GetParam().unsuspected);
  EXPECT_GT(worstOver(laws, judge(GetParam().effects)), 8 * GetParam().allowed);
}

TEST_P(AgainstJudge, TheBitIsWithinMicrometresUnderLowAndHighMotors) {
  EXPECT_LT(worstAtTheBit(GetParam()), GetParam().allowed_at_bit);
}

TEST(Balance, PullsHoldTheLoad) {
  const Machine<double> laws = lawsWith({});
  for (const Eigen::Vector2d& at : sheetPlaces()) {
    const Hanging<double> hanging = hang(laws, Point<double>{at.x(), at.y()}, true);
    const Strand<double>& left = hanging.strand[kLeft];
    const Strand<double>& right = hanging.strand[kRight];
    EXPECT_NEAR(left.pull * left.sine + right.pull * right.sine, 1, 0.05)
        << "the sled's weight, and a little chain";
    EXPECT_NEAR(left.pull * left.cosine, right.pull * right.cosine, 1e-9)
        << at.x() << " " << at.y();
    for (const Strand<double>& strand : hanging.strand) {
      EXPECT_NEAR(strand.slack * strand.pull, 1, 1e-9);
      EXPECT_NEAR(strand.bend * strand.pull, strand.cosine, 1e-9);
    }
  }
}
