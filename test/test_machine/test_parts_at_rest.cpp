// Answers, power, z, spindle, pauses and the operator, each without the rest of the
// machine.
#include "machine/reports.h"
#include "machine/telemetry.h"
#include "machine/yield_notice.h"
#include "parts.h"

using namespace machine;

struct AnswersAlone : PartsAtRest {};

TEST_F(AnswersAlone, HaltTheMachineOrSayErrorAsTheSettingAsks) {
  answers.begin("G1X5Y-2");
  EXPECT_FALSE(answers.refuseMotion(FLASH("there is no axis "), 'A'));
  EXPECT_EQ("ALARM: Halted at G1 X5 Y-2: there is no axis A. Press Stop.\r\n", board.said);
  EXPECT_TRUE(answers.isAnswered());
  EXPECT_TRUE(answers.mustHalt());
  EXPECT_FALSE(answers.mustHalt());
  values.setRow(kRefusedMotion, 1);
  board.said.clear();
  answers.begin("G77");
  EXPECT_FALSE(answers.isAnswered());
  EXPECT_FALSE(answers.refuseCode(piece("G77.1")));
  EXPECT_EQ("error: this machine does no G77.1\r\n", board.said);
  EXPECT_TRUE(answers.isAnswered());
  EXPECT_FALSE(answers.mustHalt());
}

TEST_F(AnswersAlone, RefuseWithoutAHalt) {
  answers.begin("$1");
  EXPECT_FALSE(answers.refuseStatement());
  EXPECT_EQ("error: Invalid statement\r\n", board.said);
  EXPECT_TRUE(answers.isAnswered());
  EXPECT_FALSE(answers.mustHalt());
}

struct MotorPowerAlone : PartsAtRest {
  /// As after a rest: the EEPROM holds a record that motion makes invalid.
  void keepRecord() {
    memory.keepPosition(settings::Position{});
    settings_host::settle(memory);
    axes.simulate(false);
  }
};

TEST_F(MotorPowerAlone, ComesAfterTheMarkOfMotion) {
  keepRecord();
  bool was_too_early = false;
  waiting.in_each_round = [&] { was_too_early |= axes.isPowered() && !memory.mayMove(); };
  EXPECT_FALSE(motors.areOn());
  EXPECT_TRUE(motors.wake());
  EXPECT_TRUE(motors.areOn());
  EXPECT_TRUE(memory.mayMove());
  EXPECT_FALSE(was_too_early);
  EXPECT_GT(waiting.rounds, 0);
}

TEST_F(MotorPowerAlone, NeverComesAfterAStop) {
  keepRecord();
  waiting.in_each_round = [&] { waiting.stop(); };
  EXPECT_FALSE(motors.wake());
  EXPECT_FALSE(motors.areOn());
}

TEST_F(MotorPowerAlone, GoesAfterARest) {
  EXPECT_TRUE(motors.wake());
  board.now_ms += 1999;
  motors.restWhenIdle(false);
  EXPECT_TRUE(motors.areOn());
  motors.restWhenIdle(true);
  board.now_ms += 1999;
  motors.restWhenIdle(false);
  EXPECT_TRUE(motors.areOn());
  board.now_ms += 1;
  motors.restWhenIdle(false);
  EXPECT_FALSE(motors.areOn());
}

struct MotorPowerHighUp : MotorPowerAlone {
  /// Whether the motors are on after a rest with the sled at 0,y.
  bool areOnAfterARestAt(float y) {
    hangAt(0, y);
    EXPECT_TRUE(motors.wake());
    board.now_ms += 2000;
    motors.restWhenIdle(false);
    return motors.areOn();
  }
};

TEST_F(MotorPowerHighUp, StaysWhereTheSledPullsHarderThanFriction) {
  keepRecord();
  // 1.4 N m at a radius of 10.1 mm: the chains of a sled of 97.9 N pull that hard at y = 507.
  EXPECT_FALSE(areOnAfterARestAt(500));
  EXPECT_TRUE(areOnAfterARestAt(514));
  values.setRow(kHoldingTorque, 1.45f);
  motors.restWhenIdle(false);
  EXPECT_FALSE(motors.areOn());
}

TEST_F(MotorPowerHighUp, SaysOnceThatItStays) {
  keepRecord();
  EXPECT_TRUE(areOnAfterARestAt(600));
  expectSaid("The motors stay on: so high on the sheet the sled would slide ($77).");
  board.said.clear();
  EXPECT_TRUE(areOnAfterARestAt(590));
  EXPECT_EQ("", board.said);
}

TEST_F(MotorPowerHighUp, GoesWhereNobodyKnowsWhatHangsOnTheChains) {
  keepRecord();
  hangAt(0, 600);
  place.lose(settings::Doubt::kCounts);
  EXPECT_TRUE(motors.wake());
  board.now_ms += 2000;
  motors.restWhenIdle(false);
  EXPECT_FALSE(motors.areOn());
}

TEST_F(MotorPowerHighUp, GoesWhereMotorsAreSimulated) { EXPECT_FALSE(areOnAfterARestAt(600)); }

TEST_F(MotorPowerAlone, WaitsForTheRecordForASecondWheneverThatIs) {
  board.now_ms = 5000;
  keeper.declareChains();
  axes.simulate(false);
  motors.wake();
  const int before = waiting.rounds;
  EXPECT_TRUE(motors.awaitRecord()) << "it never comes, as motors have power";
  EXPECT_NEAR(1000, waiting.rounds - before, 2);
}

struct ZAxisAlone : PartsAtRest {};

TEST_F(ZAxisAlone, KeepsItsLimitsWithTheMachineWhenZIsDeclared) {
  z.declare(5);
  EXPECT_TRUE(z.setLimit(true));
  expectSaid("Upper limit set to: 5.00");
  EXPECT_NEAR(5, z.within(7), 1e-3);
  EXPECT_FLOAT_EQ(-99, z.within(-99));
  z.declare(0);
  EXPECT_NEAR(0, z.within(7), 1e-3);
  EXPECT_TRUE(z.setLimit(false));
  EXPECT_NEAR(0, z.within(-7), 1e-3);
  z.declareInHold(-2);
  EXPECT_NEAR(-2, z.within(7), 1e-3);
  EXPECT_NEAR(-2, z.within(-7), 1e-3);
  z.clearLimits();
  EXPECT_FLOAT_EQ(7, z.within(7));
  z.showLimits();
  expectSaid("Z Axis Upper Limit: NAN Lower Limit: NAN");
  EXPECT_NEAR(12.6 * 3.17, z.mostFeed(), 1e-3);
}

struct SpindleAlone : PartsAtRest {};

TEST_F(SpindleAlone, IsWaitedForAndItsServoIsTurnedBack) {
  EXPECT_TRUE(spindle.turn(true));
  EXPECT_EQ(0, waiting.rounds);
  values.setRow(kSpindle, 1);
  EXPECT_TRUE(spindle.turn(true));
  EXPECT_EQ((std::vector<uint8_t>{90, 180, 90, kNoServo}), board.servo);
  EXPECT_EQ(7000, waiting.rounds);
  expectSaid("Turning Spindle On");
  board.servo.clear();
  waiting.stop();
  EXPECT_FALSE(spindle.turn(false));
  EXPECT_EQ((std::vector<uint8_t>{90, kNoServo}), board.servo);
}

TEST_F(SpindleAlone, ChangesItsSpeedAfterTheMovesBefore) {
  values.setRow(kSpindle, 4);
  EXPECT_TRUE(spindle.takeS(words("M3 S8000")) && spindle.turn(true));
  EXPECT_TRUE(moves.move(0, words("G0 X5")));
  EXPECT_TRUE(spindle.takeS(words("G1 S8000")));
  EXPECT_TRUE(waiting.isMoving());
  EXPECT_TRUE(spindle.takeS(words("G1 S9000")));
  EXPECT_FALSE(waiting.isMoving());
}

struct NewValuesAlone : PartsAtRest {};

TEST_F(NewValuesAlone, WaitForQuietBeforeThePlaceIsSaid) {
  new_values.take(settings::kGeometry);
  board.now_ms += 699;
  new_values.refreshWhenQuiet(false);
  EXPECT_EQ("", board.said);
  board.now_ms += 1;
  new_values.refreshWhenQuiet(true);
  EXPECT_EQ("", board.said);
  new_values.refreshWhenQuiet(false);
  expectSaid("position loaded at:");
  board.said.clear();
  new_values.refreshWhenQuiet(false);
  EXPECT_EQ("", board.said);
}

TEST_F(NewValuesAlone, LookForThePlaceBeforeAMove) {
  values.setRow(kMotorCenterX, 10);
  new_values.take(settings::kGeometry);
  EXPECT_NEAR(0, program.aim().x, 0.01);
  new_values.refreshBeforeLine();
  EXPECT_NEAR(10, program.aim().x, 0.01);
}

struct OperatorAlone : PartsAtRest {
  void send(const std::string& text) {
    for (const char c : text) operator_lines.inputFor(c).put(c);
  }
  void serveFor(uint32_t ms) {
    waiting.in_each_round = [&] { operator_lines.serve(); };
    waiting.waitFor(ms);
  }
};

TEST_F(OperatorAlone, MayAskAndMoveZButNothingElse) {
  for (const char* line :
       {"B05", "B10L", "B17", "B19", "B20", "B30", "$$", "G0Z5", "G91G0Z1", "G10Z0"})
    EXPECT_TRUE(operator_lines.isForOperator(line)) << line;
  for (const char* line : {"B06L1R1", "B04", "$1=5", "$$1", "G0X5", "G0", "G1Z1X1", "G10L20Z0",
                           "M3", "G4P1", "G90Z1", "G1Z"})
    EXPECT_FALSE(operator_lines.isForOperator(line)) << line;
}

TEST_F(OperatorAlone, JogsZInAHoldAndTheProgramGoesOnAsItWas) {
  EXPECT_TRUE(moves.move(0, words("G0 X30")));
  waiting.waitFor(500);
  operator_lines.hold();
  serveFor(800);
  send("G91\nG0Z1\nB20\n");
  serveFor(4000);
  EXPECT_NEAR(1, axes.length(kZAxis), 0.01);
  EXPECT_EQ((std::vector<bool>{true, true, true}), answered);
  EXPECT_EQ("B20", asked);
  EXPECT_TRUE(modal.relative);
  EXPECT_TRUE(waiting.course.is(State::kHeld));
  operator_lines.resume();
  serveFor(4000);
  expectSaid("Z goes back to 0.00");
  EXPECT_FALSE(modal.relative || waiting.course.isWaiting());
  EXPECT_TRUE(waiting.drain());
  expectAt(30, 0, 0);
}

TEST_F(OperatorAlone, EndsAPauseAndOneThatCameBeforeIt) {
  waiting.in_each_round = [&] {
    operator_lines.serve();
    if (waiting.rounds == 1000) operator_lines.resume();
  };
  EXPECT_TRUE(pauses.pauseAfterMoves());
  EXPECT_EQ(1001, waiting.rounds);
  expectSaid("Maslow Paused");
  EXPECT_TRUE(pauses.changeTool(0));
  EXPECT_EQ(1001, waiting.rounds);
}

TEST_F(OperatorAlone, EndsAPauseThatItsResumeCameBefore) {
  input.put('~');
  waiting.in_each_round = [&] {
    operator_lines.serve();
    if (waiting.rounds == 100) waiting.stop();
  };
  EXPECT_TRUE(pauses.pauseAfterMoves());
  EXPECT_LT(waiting.rounds, 5);
  EXPECT_FALSE(pauses.pauseAfterMoves()) << "it counts once";
}

TEST_F(OperatorAlone, MeetsNoPauseWhereAStopEndsTheMovesBeforeIt) {
  EXPECT_TRUE(moves.move(0, words("G0 X30")));
  waiting.in_each_round = [&] {
    if (waiting.rounds == 50) waiting.stop();
  };
  EXPECT_FALSE(pauses.pauseAfterMoves());
  EXPECT_EQ("", board.said);
}

TEST_F(OperatorAlone, IsNotAskedForAHeightAfterAStop) {
  EXPECT_TRUE(moves.move(0, words("G0 X30")));
  waiting.in_each_round = [&] {
    if (waiting.rounds == 50) waiting.stop();
  };
  EXPECT_FALSE(pauses.setZByHand(2, false));
  EXPECT_EQ("", board.said);
}

TEST_F(OperatorAlone, SetsZByHandWhereThereIsNoMotor) {
  values.setRow(kZMotor, 0);
  waiting.in_each_round = [&] {
    operator_lines.serve();
    if (waiting.course.is(State::kPaused)) operator_lines.resume();
  };
  EXPECT_TRUE(moves.move(0, words("G0 Z-3")));
  expectSaid("Please adjust Z-Axis to a depth of -3.00 mm");
  EXPECT_NEAR(-3, axes.length(kZAxis), 1e-3);
  EXPECT_FALSE(waiting.isMoving());
}

TEST_F(OperatorAlone, IsAskedForAHeightWithItsSign) {
  waiting.in_each_round = [&] {
    operator_lines.serve();
    if (waiting.course.is(State::kPaused)) operator_lines.resume();
  };
  for (const auto& [height, shown] :
       {std::pair<float, const char*>{0.5f, "+0.50 mm"}, {-0.5f, "-0.50 mm"}, {0, " 0.00 mm"}}) {
    board.said.clear();
    EXPECT_TRUE(pauses.setZByHand(height, false));
    expectSaid(shown);
  }
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
  modal.inches = true;
  reports.sayStatus(FLASH("Idle"), {25.4f, -50.8f, 0});
  expectSaid("<Idle,MPos:1.0000,-2.0000,0.0000,WPos:0.000,0.000,0.000>\r\n");
}

struct KeeperAlone : PartsAtRest {};

// Else a chain that is pulled while the EEPROM is written would move the start of a planned move.
TEST_F(KeeperAlone, IsNotReleasedWhileMotorsAreAboutToGetPower) {
  EXPECT_TRUE(keeper.isReleased());
  keeper.beginMoving();
  EXPECT_FALSE(keeper.isReleased());
  keeper.endWait();
  EXPECT_TRUE(keeper.isReleased());
}

struct TelemetryAlone : PartsAtRest {};

TEST_F(TelemetryAlone, KeepsWhyTheFirmwareStarted) {
  for (const Start start : {Start::kUsual, Start::kWatchdog, Start::kBrownOut, Start::kWatchdog}) {
    Telemetry telemetry(*this, place, start);
    telemetry.noteStart();
    settings_host::settle(memory);
  }
  Telemetry telemetry(*this, place, Start::kUsual);
  telemetry.tell();
  expectSaid("|start:usual|events:1,2,0,0|last:watchdog,3|slips:0,0|slipped:none,0,0,0]\r\n");
}
