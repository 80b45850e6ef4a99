// Levels of spindle and laser, and what switches them off.
#include <gtest/gtest.h>

#include "board_at_rest.h"
#include "machine/cutter.h"
#include "settings_flash.h"

using namespace machine;

namespace {

struct Pins : BoardAtRest {
  void set(Output output, bool high) override { level[int(output)] = high ? 255 : 0; }
  void pulse(Output output, uint8_t now) override { level[int(output)] = now; }
  int level[2] = {-1, -1};
};

struct Bench {
  explicit Bench(std::initializer_list<std::pair<int, float>> settings) : values(table, room) {
    for (const auto& [number, value] : settings)
      EXPECT_EQ(values.set(uint8_t(number), value), settings::Refusal::kNone);
  }
  int laser() const { return pins.level[int(Output::kLaser)]; }
  int spindle() const { return pins.level[int(Output::kSpindle)]; }

  FlashTable table;
  float room[kSettingCount];
  settings::Values values;
  Pins pins;
  Cutter cutter{pins, values};
};

}  // namespace

TEST(Laser, IsOnInG1ToG3OnlyWhenArmed) {
  Bench bench({});
  EXPECT_EQ(0, bench.cutter.beamOf(1));
  bench.cutter.setFull();
  bench.cutter.arm(true);
  for (const uint8_t motion : {0, 4, 80, 81, 255}) EXPECT_EQ(0, bench.cutter.beamOf(motion));
  for (const uint8_t motion : {1, 2, 3}) EXPECT_EQ(255, bench.cutter.beamOf(motion));
  bench.cutter.takeS(100);
  EXPECT_EQ(100, bench.cutter.beamOf(1));
  bench.cutter.takeS(12000);
  EXPECT_EQ(255, bench.cutter.beamOf(1));
  bench.cutter.takeS(0);
  EXPECT_EQ(0, bench.cutter.beamOf(1));
  bench.cutter.takeS(NAN);
  EXPECT_EQ(0, bench.cutter.beamOf(1));
  bench.cutter.takeS(7);
  bench.cutter.arm(false);
  EXPECT_EQ(0, bench.cutter.beamOf(1));
}

TEST(Laser, ShowsTheBeamOrFullPower) {
  Bench plain({}), pulsed({{72, 1}});
  for (Bench* bench : {&plain, &pulsed}) {
    bench->cutter.show(40);
    EXPECT_EQ(-1, bench->laser()) << "not armed yet";
    bench->cutter.arm(true);
    bench->cutter.show(40);
    EXPECT_EQ(bench == &plain ? 255 : 40, bench->laser());
    bench->cutter.show(0);
    EXPECT_EQ(0, bench->laser());
    bench->cutter.show(1);
    EXPECT_EQ(bench == &plain ? 255 : 1, bench->laser()) << "the weakest beam after none";
  }
}

TEST(Spindle, PwmFollowsItsSpeed) {
  Bench bench({{17, 4}, {60, 6000}, {61, 24000}});
  bench.cutter.setSpindle(true);
  EXPECT_EQ(255, bench.spindle());
  EXPECT_TRUE(bench.cutter.changesSpeed(12000));
  bench.cutter.takeS(12000);
  EXPECT_EQ(128, bench.spindle());
  EXPECT_FALSE(bench.cutter.changesSpeed(12000));
  bench.cutter.takeS(100);
  EXPECT_EQ(64, bench.spindle());
  bench.cutter.takeS(99000);
  EXPECT_EQ(255, bench.spindle());
  bench.cutter.setSpindle(false);
  EXPECT_EQ(0, bench.spindle());
  EXPECT_FALSE(bench.cutter.changesSpeed(5));
  bench.cutter.takeS(24000);
  EXPECT_EQ(0, bench.spindle());
}

TEST(Spindle, AnOverrideSlowsASpindleWithPwm) {
  Bench bench({{17, 4}, {60, 6000}, {61, 24000}});
  bench.cutter.override(50);
  EXPECT_EQ(-1, bench.spindle()) << "it does not turn";
  bench.cutter.takeS(24000);
  bench.cutter.setSpindle(true);
  EXPECT_EQ(128, bench.spindle());
  bench.cutter.override(200);
  EXPECT_EQ(255, bench.spindle());
  bench.cutter.override(10);
  EXPECT_EQ(64, bench.spindle()) << "no slower than it may";
}

TEST(Spindle, OnARelayHasNoSpeed) {
  for (const float kind : {2.0f, 3.0f}) {
    Bench bench({{17, kind}});
    bench.cutter.setSpindle(true);
    EXPECT_EQ(kind == 2 ? 255 : 0, bench.spindle());
    EXPECT_FALSE(bench.cutter.changesSpeed(5000));
    bench.cutter.off();
    EXPECT_EQ(kind == 2 ? 0 : 255, bench.spindle());
  }
}

TEST(Laser, IsOffForAMoveThatDoesNotAskForIt) {
  Bench bench({});
  bench.cutter.setFull();
  bench.cutter.arm(true);
  bench.cutter.aim(1);
  EXPECT_EQ(255, bench.cutter.takeBeam());
  EXPECT_EQ(0, bench.cutter.takeBeam()) << "a move of another code";
  bench.cutter.aim(1);
  bench.cutter.arm(false);
  EXPECT_EQ(0, bench.cutter.takeBeam());
}

TEST(Spindle, WithPwmStopsAfterItsTypeIsChanged) {
  Bench bench({{17, 4}});
  bench.cutter.setSpindle(true);
  EXPECT_EQ(255, bench.spindle());
  ASSERT_EQ(bench.values.set(17, 0), settings::Refusal::kNone);
  bench.cutter.setSpindle(false);
  EXPECT_EQ(0, bench.spindle());
}
