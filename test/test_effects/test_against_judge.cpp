// Every effect against the judge's own mechanics.
#include <gtest/gtest.h>

#include "hidden.h"

using namespace kinematics;

class AgainstJudge : public testing::TestWithParam<Hidden> {};
INSTANTIATE_TEST_SUITE_P(Effects, AgainstJudge, testing::ValuesIn(everyEffect()),
                         [](const testing::TestParamInfo<Hidden>& tested) {
                           return tested.param.name;
                         });

TEST_P(AgainstJudge, LengthsAgreeOverTheSheet) {
  reference::Machine machine = judge();
  GetParam().hide(machine);
  EXPECT_LT(worstOver(lawsWith(GetParam().sizes), machine), GetParam().allowed);
}

TEST_P(AgainstJudge, WouldMissWithoutTheEffect) {
  if (GetParam().sizes.empty()) return;
  reference::Machine machine = judge();
  GetParam().hide(machine);
  EXPECT_GT(worstOver(lawsWith({}), machine), 8 * GetParam().allowed);
}

TEST_P(AgainstJudge, TheBitIsWithinTenMicrometresUnderMotorsLowAndHigh) {
  const bool waves = GetParam().name == "sprocket_runout";  // a tenth of the amplitude is missed
  EXPECT_LT(worstAtTheBit(GetParam()), waves ? 0.011 : 0.008);
}

TEST(SledSwing, FollowsTheChainsEndsAtTheRing) {
  EXPECT_LT(worstSwing(lawsWith({{120, 3}, {121, -2}})), 0.012);
  EXPECT_GT(worstSwing(lawsWith({})), 0.5);
}
