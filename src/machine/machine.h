// The machine: what a line from the computer makes the motors do, and all it says meanwhile.
// Knows no Arduino; what it needs of a board stands in ports.h.
#pragma once

#include <GCode.h>

#include "axes.h"
#include "board_watch.h"
#include "cutter.h"
#include "edge_cut.h"
#include "feed_override.h"
#include "geometry.h"
#include "interlude.h"
#include "lock.h"
#include "mover.h"
#include "ports.h"
#include "position_keeper.h"
#include "printer.h"
#include "settings_table.h"

namespace machine {

using gcode::Input;
using gcode::Modal;
using gcode::Quick;
using gcode::Words;

/// What the machine is built of.
struct Ports {
  Wire& wire;
  Drives& drives;
  Aux& aux;
  Clock& clock;
  settings::Bytes& bytes;
  const settings::Table& table;
};

/// Which motor shield was found, and why the firmware started; without a shield no motor is ever
/// driven.
struct BoardName {
  BoardName(uint8_t version, const char* driver, Start start = Start::kUsual)
      : version(version), driver(driver), start(start) {}
  uint8_t version;     ///< N of "v1.N"
  const char* driver;  ///< as the greeting names it; null: its straps are unknown
  Start start;
};

/// Where the tool is [mm].
struct Place {
  float x, y, z;
};

/// A test of one axis' loops, as B13, B14 and B16 ask for it.
struct LoopTest {
  Axis axis;
  float first, last;
  uint8_t steps;
  uint16_t step_ms;
  uint8_t version;  ///< 2: more numbers in each line
};

/// One Maslow.
///
/// Commands run to their end in the main program. Wherever one waits, service() keeps quick
/// characters, reports, set-points and memory going, and after a stop every wait returns false, so
/// that the command unwinds. Functions that may wait return whether they were completed.
class Machine {
 public:
  Machine(const Ports& ports, const BoardName& board);

  /// Once after power-on: settings and position are read, the greeting is said.
  void begin();

  /// One round of the main program: at most one line is executed.
  void loop();

  /// The control tick; called by an interrupt, a hundred or two hundred times a second.
  void tick() {
    axes_.tick();
    cutter_.show(axes_.beam());
  }

  /// Called instead of tick() while the main program hangs; the board has taken the motors' power.
  void noteHang();

  /// How often it wants its control tick, after begin().
  uint8_t ticksPerSecond() const { return ticks_per_second_; }

 private:
  // realtime.cpp: while anything waits.
  void service();
  /// One round of a wait.
  void serveAndSleep();
  bool waitFor(uint32_t ms);
  bool drain();
  bool isFarAhead() const;
  void settle();
  void readWire();
  void stopNow();
  void finishStop();
  void resetSoftly();
  void raiseAlarm(FlashText text);
  void watchAxes();
  void sayYield();
  bool wakeMotors();
  void restWhenIdle();
  bool isMoving() const { return !mover_.isIdle() || !axes_.isEmpty(); }
  bool isHalted() const { return lock_ != Lock::kOpen; }

  // greeting.cpp, reports.cpp: what it says.
  void greet();
  void sayMotors();
  void sayStart();
  void sayReady();
  void saySource(const settings::Started& started);
  void reportWhenDue();
  void reportStatus();
  void reportErrors();
  float inUnits(float mm) const;
  float fromUnits(float value) const;

  // telemetry.cpp: how it is doing.
  void watchBoard();
  static FlashText driverText(Axis axis);
  bool tellTelemetry();

  // position.cpp: where the sled is.
  void sayPlace(float x, float y);
  void sayLengths();
  bool searchPlace();
  bool findPlace();
  void standHere();
  void restorePosition(const settings::Started& started);
  void sayUnset(bool has_defaults);
  void losePosition(FlashText why);
  void doubtCounts();
  FlashText whatIsLost() const;
  void keepWhenAtRest();
  bool awaitRecord();
  Place placeNow();

  // refusals.cpp: lines that are not done.
  void beginError();
  bool refuse(FlashText why);
  /// For whatever leaves the machine where the program does not think it is: halts it, or answers
  /// `error:`, by setting $70. `letter` ends the sentence, if there is one.
  bool refuseMotion(FlashText why, char letter = gcode::kNoLetter);
  bool refuseMistake(gcode::Mistake mistake);
  bool refuseCode(const gcode::Piece& piece);
  void beginRefusal();
  bool endRefusal();
  void beginHalt();
  bool halt();

  // commands.cpp, moves.cpp: lines of G-code.
  bool execute(char* line);
  void echo(const char* line);
  bool runCode(const char* text);
  bool runPiece(const gcode::Piece& piece);
  bool runM(uint16_t tenths, const Words& words);
  bool ignoreM(uint16_t tenths);
  bool setTool(const Words& words);
  bool declareZByWord(const Words& words);
  void takeFeed(const Words& words);
  Place counted() const;
  Place targetOf(const Words& words) const;
  bool move(uint8_t kind, const Words& words);
  bool moveStraight(Place target, bool across, float feed);
  bool isNear(const Place& target);
  bool mayTurn(const Words& words);
  /// An arc's centre by I and J, seen from its start [mm].
  motion::Point<float> centreAhead(const Words& words, motion::Point<float> from) const;
  bool moveRound(bool clockwise, motion::Point<float> from, const Place& target, const Words& words,
                 float feed);
  bool mayCrossSheet();
  /// `times` [1/min] that the move would fit, as G93 says, as a feed.
  float feedOf(const motion::Path<float>& path, const Place& target, float times) const;
  /// `feed` [mm/min], or below zero how often a minute the move would fit.
  bool queue(const motion::Path<float>& path, const Place& target, float feed);
  bool mayGo(const motion::Path<float>& path, const Area& area);
  bool queuePieces(EdgeCut cut, float z_to, float feed, uint8_t beam);
  void sayBeyondSheet(motion::Point<float> end);

  // g_codes.cpp, coordinates.cpp, drill.cpp: what each G code does.
  bool runG(const gcode::Piece& piece);
  bool beginMotion(const gcode::Piece& piece);
  bool moveInMode(const Words& words);
  bool dwell(const gcode::Piece& piece);
  bool probeDown(const gcode::Piece& piece);
  bool declareByWords(const gcode::Piece& piece);
  bool keepCoordinate(uint8_t row, float value);
  bool shiftCoordinates(const gcode::Piece& piece);
  bool endShift(const gcode::Piece& piece);
  bool takeToolLength(const gcode::Piece& piece);
  bool forgetToolLength(const gcode::Piece& piece);
  bool keepGoal(const gcode::Piece& piece);
  bool goToKept(const gcode::Piece& piece);
  bool goSafely(const Place& target, bool across);
  void sayPlaceOf(FlashText name, int32_t number, float x, float y, float z);
  void showCoordinates();
  bool beginCycle(const gcode::Piece& piece);
  bool refuseDrilling(gcode::DrillFault fault);
  bool drill(const Words& words);
  bool runDrillStep(const gcode::DrillStep& step);

  // settings_lines.cpp: the `$` lines.
  bool runSetting(const char* line);
  bool runReset(const char* what);
  void dumpSettings();
  bool setValue(uint8_t number, float value);
  bool refuseChainSpeed();
  /// Works out again what new values touch; bits of settings::Touch.
  void takeOver(uint8_t touches);
  void arrangeDrives();
  void refreshGeometry();
  void refreshGeometryWhenQuiet();
  void restoreDefaults(settings::Reset what);

  // interlude.cpp: what is done while the program waits.
  void holdMotion();
  void resumeInterlude();
  void serveInterlude();
  bool bringZBack();
  void serveOperator();
  bool isForOperator(const char* line) const;
  bool isForOperator(const gcode::Piece& piece) const;
  bool runForOperator(const char* line);
  bool jogZ(const Words& words);
  void declareZInInterlude(float z);
  void changeFeed(Quick quick);

  // pause.cpp, spindle.cpp, probe.cpp, z_limits.cpp.
  bool pause(bool resumed);
  bool pauseAfterMoves();
  bool changeTool(uint16_t tool);
  bool setZByHand(float z);
  bool turnServo(uint8_t angle);
  bool switchSpindle(bool on);
  void switchLaser(bool on);
  bool takeS(const Words& words);
  bool probe(float target);
  float mostZFeed() const;
  float withinZLimits(float z) const;
  bool setZLimit(bool upper);
  bool clearZLimits();
  void sayZLimit(float limit);
  void shiftZLimits(float shift);
  bool showZLimits();
  void declareZ(float z);

  // b_codes.cpp, single_axis.cpp, motor_tests.cpp, loop_tests.cpp: single axes.
  bool moveAxis(Axis axis, float goal, float feed, bool until_probe);
  static bool isQuestion(const char* line);
  /// B17 to B19, which move nothing.
  static bool isZLimitCode(const char* line);
  bool runB(const char* line);
  bool runChainCode(uint8_t code, const Words& words);
  bool runTestCode(uint8_t code, const Words& words);
  bool pullByWords(const Words& words);
  bool measureOut(Axis axis);
  bool setChains(float left, float right);
  bool moveChains(const Words& words);
  bool goHome();
  bool measureChain(bool left);
  bool simulateMotors(bool on);
  bool driveFor(Axis axis, int16_t duty, uint32_t ms);
  bool rampMotor(Axis axis, int8_t sign);
  bool testDirection(Axis axis, int8_t direction);
  bool testMotors();
  bool pullChain(Axis axis, int16_t duty, float seconds);
  void sayGains(Axis axis, bool position);
  bool sampleSpeed(Axis axis, float rpm, uint8_t version);
  bool testLoop(uint8_t code, const LoopTest& test);
  bool testSpeeds(const LoopTest& test);
  bool sampleLength(Axis axis, float goal, uint16_t ms, uint8_t version);
  bool testLengths(const LoopTest& test);
  bool testDuties(const LoopTest& test);

  Wire& wire_;
  Drives& drives_;
  Aux& aux_;
  Clock& clock_;
  BoardName board_;
  Printer out_;
  const settings::Table& table_;
  float value_room_[kSettingCount];
  settings::Values values_;
  settings::Memory memory_;
  Geometry geometry_;
  Axes axes_;
  BoardWatch board_watch_;
  PositionKeeper keeper_;
  Cutter cutter_;
  Mover mover_;
  Input input_;
  Modal modal_;
  gcode::WorkOffsets offsets_;
  gcode::Drilling drilling_;
  const char* line_ = "";  ///< the line in execution
  Lock lock_ = Lock::kOpen;
  Place aim_ = {0, 0, 0};                  ///< where the last move queued ends
  motion::Point<float> counted_ = {0, 0};  ///< [mm] the same to the program, also beyond the sheet
  Place place_ = {0, 0, 0};                ///< where the tool was when somebody last asked
  uint32_t last_report_ms_ = 0, last_motion_ms_ = 0, geometry_changed_ms_ = 0;
  uint32_t board_looked_ms_ = 0;
  uint8_t ticks_per_second_ = 100;
  volatile bool hung_ = false;
  bool stopping_ = false;  ///< a stop was asked for; every wait ends
  Interlude interlude_;
  FeedOverride feed_;
  bool is_answered_ = false;  ///< the line in execution has got its answer
  uint32_t yields_since_ms_ = 0, last_yield_ms_ = 0;
  bool has_said_yield_ = false;  ///< in this motion
  bool is_testing_ = false;      ///< a test of loops jumps to and fro
  bool is_place_known_ = false;
  bool is_geometry_stale_ = false;
};

}  // namespace machine
