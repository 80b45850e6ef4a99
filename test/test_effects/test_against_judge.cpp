// Every effect against the mechanics of the judge, and the pulls of both chains.
#include <gtest/gtest.h>

#include "hidden.h"

using namespace kinematics;

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
