// Moves, holes, coordinates and single axes, each without the rest of the machine.
#include "parts.h"

using namespace machine;

struct MovesAlone : PartsAtRest {};

TEST_F(MovesAlone, GoToTheTargetAndCountFromIt) {
  EXPECT_TRUE(moves.move(1, words("G1 X20 Y-10 Z-1")));
  EXPECT_TRUE(waiting.isMoving());
  EXPECT_TRUE(waiting.drain());
  expectAt(20, -10, -1);
  modal.relative = true;
  EXPECT_TRUE(moves.move(0, words("G0 X5")));
  EXPECT_FLOAT_EQ(25, program.aim().x);
  modal.inches = true;
  EXPECT_TRUE(moves.move(0, words("G0 Y1")));
  EXPECT_FLOAT_EQ(15.4f, program.aim().y);
}

TEST_F(MovesAlone, KeepToTheSheetWhileTheProgramCountsBeyondIt) {
  hangAt(1200, 0);
  EXPECT_TRUE(moves.move(0, words("G0 X1300")));
  EXPECT_FLOAT_EQ(1219.2f, program.aim().x);
  EXPECT_FLOAT_EQ(1300, program.counted().x);
  EXPECT_TRUE(program.isCountedBeyond());
  expectSaid("leads beyond the sheet");
  board.said.clear();
  EXPECT_TRUE(moves.move(0, words("G0 X1301")));
  EXPECT_EQ("", board.said) << "once for each time that the path leaves it";
  // The program goes on from where it counts, after a rest too.
  modal.relative = true;
  EXPECT_TRUE(moves.move(0, words("G0 X-1")));
  EXPECT_FLOAT_EQ(1300, program.counted().x);
  EXPECT_TRUE(waiting.drain());
  axes.releaseAll();
  EXPECT_TRUE(moves.move(0, words("G0 X-1")));
  EXPECT_FLOAT_EQ(1299, program.counted().x);
}

TEST_F(MovesAlone, AreRefusedWhereThePlaceIsNotKnown) {
  keeper.doubt(kLeftAxis, settings::Doubt::kCounts);
  EXPECT_FALSE(moves.move(0, words("G0 X1")));
  expectSaid("Position Lost: set the chain lengths first");
  EXPECT_TRUE(answers.mustHalt());
  EXPECT_FALSE(waiting.isMoving());
  EXPECT_TRUE(moves.move(0, words("G0 Z1")));
}

TEST_F(MovesAlone, WaitForRoomInTheQueueAndEndThereAfterAStop) {
  for (int i = 1; i <= 16; ++i) EXPECT_TRUE(moves.move(0, words(i % 2 ? "G0 X9" : "G0 X0")));
  waiting.rounds = 0;
  waiting.in_each_round = [&] {
    if (waiting.rounds == 5) waiting.stop();
  };
  bool was_stopped = false;
  for (int i = 0; i < 16 && !was_stopped; ++i)
    was_stopped = !moves.move(0, words(i % 2 ? "G0 X9" : "G0 X0"));
  EXPECT_TRUE(was_stopped);
  EXPECT_EQ(5, waiting.rounds);
}

TEST_F(MovesAlone, TakeTheFeedInItsUnitsAndCapIt) {
  moves.takeFeed(words("G1 F300"));
  EXPECT_FLOAT_EQ(300, moves.feedOf(1));
  moves.takeFeed(words("G1 F5000"));
  EXPECT_FLOAT_EQ(900, moves.feedOf(1));
  EXPECT_FLOAT_EQ(900, moves.feedOf(0));
  modal.inches = true;
  moves.takeFeed(words("G1 F10"));
  EXPECT_FLOAT_EQ(254, moves.feedOf(1));
  modal.inverse_time = true;
  moves.takeFeed(words("G1 F4"));
  EXPECT_FLOAT_EQ(-4, moves.feedOf(1));
}

TEST_F(MovesAlone, TakeTheTimeThatInverseTimeAsksFor) {
  modal.inverse_time = true;
  EXPECT_FALSE(moves.move(1, words("G1 X10")));
  EXPECT_TRUE(moves.move(1, words("G1 X10 F6")) && waiting.drain());
  EXPECT_NEAR(10000, waiting.rounds, 300);
}

TEST_F(MovesAlone, GoToAKeptPlaceFirstUpThenAcross) {
  EXPECT_FALSE(moves.goToKept(piece("G28")));
  expectSaid("no place is kept for it");
  EXPECT_TRUE(moves.move(0, words("G0 X30 Y10 Z2")) && waiting.drain());
  EXPECT_TRUE(coordinates.keepGoal(piece("G28.1")));
  EXPECT_TRUE(moves.move(0, words("G0 X0 Y0 Z-1")) && waiting.drain());
  float highest_before_crossing = -9;
  waiting.in_each_round = [&] {
    const Place at = place.now(true);
    if (at.x < 0.1f) highest_before_crossing = std::max(highest_before_crossing, at.z);
  };
  EXPECT_TRUE(moves.goToKept(piece("G28")) && waiting.drain());
  EXPECT_NEAR(2, highest_before_crossing, 0.01);
  expectAt(30, 10, 2);
}

struct DrillingAlone : PartsAtRest {};

TEST_F(DrillingAlone, MakesAHoleAndComesBackUp) {
  EXPECT_TRUE(moves.move(0, words("G0 Z2")) && waiting.drain());
  drilling.begin(81);
  float deepest = 9;
  waiting.in_each_round = [&] { deepest = std::min(deepest, axes.length(kZAxis)); };
  EXPECT_TRUE(drilling.drill(words("G81 X10 Y5 Z-1 R0.5")) && waiting.drain());
  EXPECT_NEAR(-1, deepest, 0.01);
  expectAt(10, 5, 2);
}

TEST_F(DrillingAlone, RefusesAHoleBeyondTheSheet) {
  drilling.begin(81);
  hangAt(1210, 0);
  EXPECT_FALSE(drilling.drill(words("G81 X1300 Y0 Z-1 R0")));
  expectSaid("the hole is beyond the sheet");
  EXPECT_FALSE(drilling.drill(words("G81 X0 Z-1")) && !answers.isAnswered());
}

struct CoordinatesAlone : PartsAtRest {};

TEST_F(CoordinatesAlone, BeginWhereTheyAreDeclared) {
  EXPECT_TRUE(moves.move(0, words("G0 X20 Y10")) && waiting.drain());
  EXPECT_TRUE(coordinates.declare(words("G10 L20 P2 X5 Y0")));
  EXPECT_FLOAT_EQ(0, coordinates.begin(0));
  modal.system = 1;
  EXPECT_FLOAT_EQ(15, coordinates.begin(0));
  EXPECT_FLOAT_EQ(10, coordinates.begin(1));
  EXPECT_TRUE(coordinates.shift(words("G92 X0")));
  EXPECT_FLOAT_EQ(20, coordinates.begin(0));
  coordinates.endShift(921);
  EXPECT_FLOAT_EQ(15, coordinates.begin(0));
  EXPECT_TRUE(coordinates.takeToolLength(words("G43.1 Z7")));
  EXPECT_FLOAT_EQ(7, coordinates.begin(2));
  coordinates.forgetToolLength();
  EXPECT_FLOAT_EQ(0, coordinates.begin(2));
}

TEST_F(CoordinatesAlone, RefuseWhatHasNoMeaning) {
  for (const char* text : {"G10 L3 P1 X0", "G10 L2 P7 X0", "G10 L2 P1.5 X0", "G10 L2 P1 X30000"}) {
    answers.begin(text);
    EXPECT_FALSE(coordinates.declare(words(text))) << text;
  }
  EXPECT_FALSE(coordinates.shift(words("G92")));
  EXPECT_FALSE(coordinates.keepGoal(piece("G28.1 X1")));
  keeper.doubt(kZAxis, settings::Doubt::kCounts);
  EXPECT_FALSE(coordinates.shift(words("G92 X0")));
  EXPECT_FALSE(coordinates.declare(words("G10 L20 P1 X0")));
  EXPECT_TRUE(coordinates.declare(words("G10 L2 P1 X0")));
  EXPECT_TRUE(coordinates.shift(words("G92 Z0")));
}

struct SingleAxisAlone : PartsAtRest {};

TEST_F(SingleAxisAlone, TakesTheChainsLengthsAndLooksForThePlace) {
  keeper.doubt(kLeftAxis, settings::Doubt::kCounts);
  EXPECT_TRUE(single_axis.setChains(1700, 1700));
  EXPECT_TRUE(place.isKnown());
  EXPECT_NEAR(0, program.aim().x, 0.01);
  expectSaid("Left: 1700.00mm");
  EXPECT_FALSE(single_axis.setChains(17000, 1700));
}

TEST_F(SingleAxisAlone, MovesChainsToOrByLengths) {
  modal.relative = true;
  const float before = axes.length(kLeftAxis);
  EXPECT_TRUE(single_axis.moveChains(words("L2 R0")));
  EXPECT_NEAR(before + 2, axes.length(kLeftAxis), 0.01);
  modal.relative = false;
  EXPECT_TRUE(single_axis.moveChains(words("L1700 R1701")));
  EXPECT_NEAR(1700, axes.length(kLeftAxis), 0.01);
  EXPECT_NEAR(1701, axes.length(kRightAxis), 0.01);
  EXPECT_TRUE(single_axis.goHome());
  expectAt(0, 0, 0);
}

TEST_F(SingleAxisAlone, MakesZeroWhereTheProbeTouches) {
  waiting.in_each_round = [&] { board.touches = axes.length(kZAxis) < -1; };
  EXPECT_TRUE(single_axis.probe(-5, true, true));
  EXPECT_NEAR(0, axes.length(kZAxis), 0.05);
  EXPECT_FALSE(waiting.isMoving());
  expectSaid("z axis zeroed");
  board.touches = true;
  EXPECT_FALSE(single_axis.probe(-5, true, true));
  expectSaid("the probe touches already");
  board.touches = false;
  waiting.in_each_round = [] {};
  EXPECT_FALSE(single_axis.probe(-0.5f, true, true));
  expectSaid("probe did not connect");
  EXPECT_NEAR(axes.length(kZAxis), program.aim().z, 0.01) << "the next move begins there";
}

struct AxisTestsAlone : PartsAtRest {};

TEST_F(AxisTestsAlone, SayWhetherAnEncoderCountsTheRightWay) {
  axes.simulate(false);
  waiting.in_each_round = [&] {
    board.counted[kLeftAxis] = uint16_t(board.counted[kLeftAxis] - board.duty[kLeftAxis] / 64);
    board.counted[kRightAxis] = uint16_t(board.counted[kRightAxis] + board.duty[kRightAxis] / 64);
  };
  EXPECT_TRUE(axis_tests.testMotors());
  expectSaid("Testing L motor:\r\nDirection 1 - Pass\r\nDirection 2 - Pass");
  expectSaid("Testing R motor:\r\nDirection 1 - Fail\r\nDirection 2 - Fail");
  expectSaid("Testing Z motor:\r\nDirection 1 - Fail");
  EXPECT_FALSE(axes.isPowered());
}

TEST_F(AxisTestsAlone, MakeErrorsOnPurposeOnlyWhileTheyLast) {
  bool was_testing = false;
  waiting.in_each_round = [&] {
    was_testing = axis_tests.isTesting();
    if (board.now_ms > 3000) waiting.stop();
  };
  EXPECT_FALSE(axis_tests.testLoop(13, {kLeftAxis, 5, 5, 2, 0, 1}));
  EXPECT_TRUE(was_testing);
  EXPECT_FALSE(axis_tests.isTesting());
  EXPECT_FALSE(axes.isPowered() && axes.isDriven());
}
