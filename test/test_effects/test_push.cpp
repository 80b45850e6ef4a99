// Effects that push the sled.
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
