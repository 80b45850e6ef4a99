// Motor power, what the operator may do, reports and telemetry, each without the rest of the
// machine.
#include "machine/reports.h"
#include "machine/telemetry.h"
#include "machine/yield_notice.h"
#include "parts.h"

using namespace machine;

struct MotorPowerAlone : PartsAtRest {
  /// As after a rest: the EEPROM holds a record that motion makes invalid.
  void keepRecord() {
    memory.keepPosition(settings::Position{});
    settings_host::settle(memory);
    axes.simulate(false);
  }
};

TEST_F(MotorPowerAlone, IsNotSwitchedOnAfterAStop) {
  keepRecord();
  waiting.in_each_round = [&] { waiting.stop(); };
  EXPECT_FALSE(motors.wake());
  EXPECT_FALSE(axes.isPowered());
}

struct MotorPowerHighUp : MotorPowerAlone {
  /// Whether the motors are on after a rest with the sled at 0,y.
  bool areOnAfterARestAt(float y) {
    hangAt(0, y);
    EXPECT_TRUE(motors.wake());
    board.now_ms += 2000;
    motors.restWhenIdle(false);
    return axes.isPowered();
  }
};

TEST_F(MotorPowerHighUp, StaysOnWhereTheSledPullsHarderThanFriction) {
  keepRecord();
  // 1.4 N m at a radius of 10.1 mm: the chains of a sled of 97.9 N pull that hard at y = 507.
  EXPECT_FALSE(areOnAfterARestAt(500));
  EXPECT_TRUE(areOnAfterARestAt(514));
  values.setRow(kHoldingTorque, 1.45f);
  motors.restWhenIdle(false);
  EXPECT_FALSE(axes.isPowered());
}

TEST_F(MotorPowerHighUp, GoesOffAtAnUnknownPlace) {
  keepRecord();
  hangAt(0, 600);
  place.lose(settings::Doubt::kCounts);
  EXPECT_TRUE(motors.wake());
  board.now_ms += 2000;
  motors.restWhenIdle(false);
  EXPECT_FALSE(axes.isPowered());
}

TEST_F(MotorPowerHighUp, GoesOffWithSimulatedMotors) { EXPECT_FALSE(areOnAfterARestAt(600)); }

TEST_F(MotorPowerAlone, WaitsUpToASecondForTheRecord) {
  board.now_ms = 5000;
  keeper.declareChains();
  axes.simulate(false);
  motors.wake();
  const int before = waiting.rounds;
  EXPECT_TRUE(motors.awaitRecord()) << "it never comes, as motors have power";
  EXPECT_NEAR(1000, waiting.rounds - before, 2);
}

struct OperatorAlone : PartsAtRest {};

TEST_F(OperatorAlone, MayOnlyAskAndMoveZ) {
  for (const char* line :
       {"B05", "B10L", "B17", "B19", "B20", "B30", "$$", "G0Z5", "G91G0Z1", "G10Z0"})
    EXPECT_TRUE(operator_lines.isForOperator(line)) << line;
  for (const char* line : {"B06L1R1", "B04", "$1=5", "$$1", "G0X5", "G0", "G1Z1X1", "G10L20Z0",
                           "M3", "G4P1", "G90Z1", "G1Z"})
    EXPECT_FALSE(operator_lines.isForOperator(line)) << line;
}

TEST(YieldNotice, ComesOnceInAMotionThatYieldsForASecond) {
  YieldNotice notice;
  int said = 0;
  uint32_t now = 0;
  const auto pass = [&](int ms, bool yields, bool is_moving) {
    for (int i = 0; i < ms; ++i) said += notice.isDue(yields, is_moving, ++now);
  };
  pass(500, false, true);
  pass(999, true, true);
  EXPECT_EQ(0, said);
  pass(100, false, true);
  pass(999, true, true);
  EXPECT_EQ(0, said);
  pass(5000, true, true);
  EXPECT_EQ(1, said);
  pass(1, false, false);
  pass(2000, true, true);
  EXPECT_EQ(2, said);
}

struct ReportsAlone : PartsAtRest {};

TEST_F(ReportsAlone, AreDueEveryFifthOfASecond) {
  Reports reports(*this);
  int due = 0;
  for (int i = 0; i < 1000; ++i, ++board.now_ms) due += reports.areDue();
  EXPECT_EQ(4, due);
}

struct KeeperAlone : PartsAtRest {};

// Otherwise pulling a chain while the EEPROM is written would shift the start of a planned move.
TEST_F(KeeperAlone, KeepsMotorsWhileTheyAreAboutToGetPower) {
  EXPECT_TRUE(keeper.isReleased());
  keeper.beginMoving();
  EXPECT_FALSE(keeper.isReleased());
  keeper.endWait();
  EXPECT_TRUE(keeper.isReleased());
}

struct TelemetryAlone : PartsAtRest {};

TEST_F(TelemetryAlone, KeepsWhyTheFirmwareStarted) {
  for (const Start start : {Start::kUsual, Start::kWatchdog, Start::kBrownOut, Start::kWatchdog}) {
    Telemetry telemetry(*this, start);
    telemetry.noteStart();
    settings_host::settle(memory);
  }
  Telemetry telemetry(*this, Start::kUsual);
  telemetry.tell();
  expectSaid("|start:usual|events:1,2,0,0|last:watchdog,3|slips:0,0|slipped:none,0,0,0]\r\n");
}
