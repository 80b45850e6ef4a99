// Motor power, what the operator may do, waits, the sled's place, reports and telemetry, each
// without the rest of the machine.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <tuple>

#include "../settings_host/eeprom.h"
#include "board_at_rest.h"
#include "machine/parts.h"
#include "machine/reports.h"
#include "machine/telemetry.h"
#include "machine/yield_notice.h"
#include "settings_flash.h"

using namespace machine;

/// A main program whose rounds take a millisecond each; motors are simulated by B99.
struct Rounds : machine::Waiting {
  Rounds(BoardAtRest& board, machine::Parts& parts)
      : Waiting(board, parts.axes, parts.planner, parts.course),
        course(parts.course),
        board_(board),
        parts_(parts) {}

  void service() override {
    ++rounds;
    in_each_round();
    parts_.planner.fill(axes_, parts_.geometry);
    parts_.memory.step();
    if (++board_.now_ms % 10 == 0) axes_.tick();
  }
  bool runQuestion(const char*) override { return true; }
  void answer(bool) override {}
  void stop() { course.take(machine::Event::kStop); }

  machine::Course& course;
  int rounds = 0;
  std::function<void()> in_each_round = [] {};

 private:
  BoardAtRest& board_;
  machine::Parts& parts_;
};

/// What a machine needs of a board.
struct BoardOfParts {
  BoardAtRest board;
  settings_host::Eeprom eeprom;
  FlashTable table;
};

/// A machine with a ring whose sled hangs in the middle of the sheet.
struct PartsAtRest : testing::Test, BoardOfParts, machine::Parts {
  PartsAtRest()
      : Parts({board, board, board, board, eeprom, BoardOfParts::table},
              {2, "", machine::Start::kUsual}, waiting),
        waiting(board, *this) {
    memory.start();
    values.setRow(kKinematics, 2);
    values.setRow(kRotationRadius, 139);
    values.setRow(kZPositionP, 1300);
    axes.simulate(true);
    new_values.takeAll();
    modal.feed = 600;
    hangAt(0, 0);
    board.said.clear();
  }

  void hangAt(float x, float y) {
    const motion::Lengths<float> lengths = geometry.inverse({x, y});
    axes.declare(machine::kLeftAxis, lengths.left);
    axes.declare(machine::kRightAxis, lengths.right);
    keeper.declareChains();
    place.search(machine::Search::kHalted);
  }

  /// The words of a line's first code.
  static gcode::Words words(const char* text) {
    gcode::Piece piece;
    gcode::Pieces(text).next(piece);
    return piece.words;
  }

  void expectSaid(const std::string& text) {
    EXPECT_NE(std::string::npos, board.said.find(text)) << "said: " << board.said;
  }
  Rounds waiting;
};

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

struct MovesAlone : PartsAtRest {};

TEST_F(MovesAlone, WaitForRoomInTheQueueUntilAStop) {
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

struct AxisTestsAlone : PartsAtRest {};

TEST_F(AxisTestsAlone, CountAsTestingOnlyWhileTheyRun) {
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

namespace {

struct PlaceAlone : PartsAtRest {};

TEST_F(PlaceAlone, IsUnknownIfTheChainsFitNoPlace) {
  const auto isPlaceKept = [&] {
    for (int i = 0; i < 1000; ++i) {
      waiting.pass();
      place.keepWhenAtRest(board.now_ms);
    }
    return settings::Memory(eeprom, values).start().position.has_place;
  };
  axes.simulate(false);
  EXPECT_TRUE(isPlaceKept());
  axes.declare(kLeftAxis, 100);
  axes.declare(kRightAxis, 100);
  keeper.declareChains();
  EXPECT_FALSE(isPlaceKept());
}

TEST_F(PlaceAlone, IsSearchedAgainAfterAChainIsPulled) {
  axes.simulate(false);
  waiting.in_each_round = [&] { place.keepWhenAtRest(board.now_ms); };
  waiting.waitFor(1000);
  for (const auto& [counts, least, most] :
       {std::tuple<int, float, float>{45, 0, 0}, {128, 0.3f, 2}}) {
    place.search(Search::kHalted);
    const Place before = program.aim();
    board.counted[kLeftAxis] = uint16_t(board.counted[kLeftAxis] + counts);
    waiting.waitFor(1000);
    const float moved = float(std::hypot(program.aim().x - before.x, program.aim().y - before.y));
    EXPECT_GE(moved, least) << counts;
    EXPECT_LE(moved, most) << counts;
  }
}

}  // namespace

struct WaitingAlone : PartsAtRest {};

TEST_F(WaitingAlone, LastsItsTimeOrUntilAStop) {
  EXPECT_TRUE(waiting.waitFor(50));
  EXPECT_EQ(50, waiting.rounds);
  waiting.in_each_round = [&] {
    if (waiting.rounds == 60) waiting.stop();
  };
  EXPECT_FALSE(waiting.waitFor(50));
  EXPECT_EQ(60, waiting.rounds);
  EXPECT_FALSE(waiting.drain());
  EXPECT_FALSE(waiting.waitWhile([] { return true; }));
  EXPECT_EQ(60, waiting.rounds);
}

TEST_F(WaitingAlone, GivesUpAfterHalfASecondOnAMissingAxis) {
  axes.simulate(false);
  axes.jumpTo(kLeftAxis, axes.length(kLeftAxis) + 1);
  waiting.settle();
  EXPECT_EQ(500, waiting.rounds);
}

TEST_F(WaitingAlone, EndsOnceAxesAreNearTheirSetPoints) {
  axes.simulate(false);
  axes.jumpTo(kLeftAxis, axes.length(kLeftAxis) + 1);
  waiting.stop();
  waiting.awaitStandstill();
  EXPECT_EQ(20, waiting.rounds) << "an axis without power goes nowhere";
  axes.follow();
  waiting.rounds = 0;
  waiting.awaitStandstill();
  EXPECT_EQ(219, waiting.rounds) << "its encoder shows nothing";
}

TEST_F(WaitingAlone, GoesOnAfterTheLastSetPointUntilTheMotorsArrive) {
  axes.simulate(false);
  EXPECT_TRUE(moves.move(0, words("G0 Z-0.1")));
  int rounds_still = 0;
  waiting.in_each_round = [&] { rounds_still += !waiting.isMoving(); };
  EXPECT_TRUE(waiting.drain());
  EXPECT_NEAR(500, rounds_still, 2);
}

TEST_F(WaitingAlone, DoesNotWaitForAMotorWithoutPower) {
  axes.simulate(false);
  axes.jumpTo(kLeftAxis, axes.length(kLeftAxis) + 1);
  EXPECT_TRUE(waiting.drain());
  EXPECT_EQ(0, waiting.rounds) << "a motor without power never comes nearer";
}
