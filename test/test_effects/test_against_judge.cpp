// Every effect against the mechanics of the judge.
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
