// The machine: what a line from the computer makes the motors do, and everything that it says.
// Without Arduino: ports.h holds what it needs of a board. README.md says which part does what.
#pragma once

#include "axis_tests.h"
#include "drilling.h"
#include "greeting.h"
#include "operator_lines.h"
#include "overrides.h"
#include "reports.h"
#include "settings_lines.h"
#include "single_axis.h"
#include "telemetry.h"
#include "yield_notice.h"

namespace machine {

/// A Maslow: its parts, the main program, and which part does which line.
///
/// Commands run to their end in the main program. While a command waits, service() keeps everything
/// else going (waiting.h). Functions that may wait return whether they were completed.
class Machine : private Waiting, private Dispatch {
 public:
  Machine(const Ports& ports, const BoardName& board);

  /// To be called once after power-on: reads settings and position, and says the greeting.
  __attribute__((noinline)) void begin();

  /// A round of the main program: executes at most one line.
  void loop();

  /// The control tick. An interrupt calls it 100 or 200 times a second.
  void tick() {
    base_.axes.tick();
    base_.cutter.show(base_.axes.beam());
  }

  /// Called in place of tick() while the main program hangs. The board has taken the power off the
  /// motors.
  void noteHang();

  /// How often the machine needs its control tick; known after begin().
  uint8_t ticksPerSecond() const { return ticks_per_second_; }

  // What a dry run looks at.
  const Course& course() const { return base_.course; }
  const Axes& axes() const { return base_.axes; }
  const Planner& planner() const { return base_.planner; }
  const gcode::Modal& modal() const { return base_.modal; }
  const SledPlace& place() const { return place_; }
  const ProgramPlace& program() const { return base_.program; }
  const Coordinates& coordinates() const { return coordinates_; }

 private:
  typedef bool (Machine::*RunPiece)(const gcode::Piece& piece);
  typedef bool (Machine::*RunB)(uint8_t code, const gcode::Words& words);
  struct Code;
  struct BCode;

  // realtime.cpp: what goes on while anything waits; stops and alarms.
  void service() override;
  __attribute__((noinline)) void keepReporting();
  void readWire();
  void takeQuick(gcode::Quick quick);
  void stopNow();
  void forgetLines();
  void forgetUnanswered();
  void finishStop();
  void resetSoftly();
  /// What a person does after an alarm.
  enum class Remedy : uint8_t { kOpen, kLookForHold, kMendAndSet, kSwitchOff };
  /// Says the texts and the remedy as one line.
  void raiseAlarm(Remedy remedy, FlashText text, FlashText more = FLASH(""),
                  FlashText last = FLASH(""));
  void sayRemedy(Remedy remedy);
  void watchStack();
  void watchAxes();
  void watchEncoders();
  void raiseAlarmOf(Axes::AxisFault worst);
  void override(gcode::Quick quick);
  void resetOverrides();
  void applyOverrides();
  bool isHalted() const { return base_.course.isHalted(); }
  Place placeNow();
  bool isFarAhead() const;

  // commands.cpp: turns a line into pieces.
  __attribute__((noinline)) bool execute(char* line);
  bool mayRun(Kind kind) const;
  bool refuseNow(Kind kind);
  void answer(bool done) override;
  void halt();
  void echo(const char* line);
  bool runCode(const char* text);
  bool runPiece(const gcode::Piece& piece);
  bool moveInMode(const gcode::Words& words);
  bool riseAfterCycle(const gcode::Words& words);
  bool setTool(const gcode::Words& words);
  bool runQuestion(const char* line) override;
  bool runSetting(const char* line);
  bool runReset(const char* what);
  void restoreDefaults(settings::Reset what);

  // grbl.cpp: what a sender of Grbl asks for.
  void askStatus(bool is_in_line);
  void answerStatus();
  FlashText stateForGrbl();
  void sayPlace(const Place& place);
  bool isOfMaslow(const char* line) const;
  void speakMaslow();
  void resetAsGrbl();
  void resetModes();
  __attribute__((noinline)) bool runGrbl(const char* line);
  void showCoordinates();
  void sayProbed();
  void showModes();
  bool unlock();
  bool toggleCheck();
  bool checkCode(const char* text);

  // jogs.cpp: `$J=`, and the end of a jog.
  bool jog(const char* text);
  bool queueJog(const char* text);
  bool readJog(const char* text, gcode::Words& words);
  void endJog();
  bool isDroppedJog(const char* line);

  // codes.cpp: what each G and M code does, by a table.
  static bool find(const gcode::Piece& piece, Code& found);
  static bool knows(const gcode::Piece& piece);
  bool run(const gcode::Piece& piece);
  bool ignoreM(const gcode::Piece& piece);
  bool beginMotion(const gcode::Piece& piece);
  bool dwell(const gcode::Piece& piece);
  bool declare(const gcode::Piece& piece);
  bool keepGoal(const gcode::Piece& piece) { return coordinates_.keepGoal(piece); }
  bool goToKept(const gcode::Piece& piece) { return moves_.goToKept(piece); }
  bool probe(const gcode::Piece& piece);
  bool takeToolLength(const gcode::Piece& piece);
  bool forgetToolLength(const gcode::Piece& piece);
  bool beginCycle(const gcode::Piece& piece);
  bool shift(const gcode::Piece& piece) { return coordinates_.shift(piece.words); }
  bool endShift(const gcode::Piece& piece);
  bool pause(const gcode::Piece&) { return pauses_.pauseAfterMoves(); }
  bool endProgram(const gcode::Piece&);
  bool startSpindle(const gcode::Piece& piece);
  bool stopSpindle(const gcode::Piece&) { return drain() && spindle_.turn(false); }
  bool changeTool(const gcode::Piece& piece);
  bool armLaser(const gcode::Piece& piece);
  bool refuseSubprogram(const gcode::Piece&);

  // b_codes.cpp: what each B code does, by a table.
  bool runB(const char* line);
  bool sayVersion(uint8_t, const gcode::Words&);
  bool sayNoCalibration(uint8_t, const gcode::Words&);
  bool measureOut(uint8_t, const gcode::Words& words);
  /// Gives the motors power for a test that drives them in a hold too: it begins after the hold.
  bool wakeForTest();
  bool testMotors(uint8_t, const gcode::Words&);
  bool setChains(uint8_t, const gcode::Words& words);
  bool setChainsToMarks(uint8_t, const gcode::Words&) { return single_axis_.setChainsToMarks(); }
  bool moveChains(uint8_t, const gcode::Words& words) { return single_axis_.moveChains(words); }
  bool measureChain(uint8_t, const gcode::Words& words);
  bool pullChain(uint8_t, const gcode::Words& words);
  bool testLoop(uint8_t code, const gcode::Words& words);
  bool goHome(uint8_t, const gcode::Words&) { return single_axis_.goHome(); }
  bool setZLimit(uint8_t code, const gcode::Words&) { return z_.setLimit(code == 17); }
  bool clearZLimits(uint8_t, const gcode::Words&) { return z_.clearLimits(); }
  bool showZLimits(uint8_t, const gcode::Words&) { return z_.showLimits(); }
  bool tellTelemetry(uint8_t, const gcode::Words&);
  /// B99: only the word ON simulates the motors.
  bool switchMotors(const char* word);
  bool simulateMotors(bool on);
  /// Waits until the settings in force outlive a power cut; false after a stop.
  bool awaitStored();

  // Each part knows the parts above it, never the parts below.
  Basis base_;
  Overrides overrides_;
  Greeting greeting_;
  SledPlace place_;
  Reports reports_;
  Telemetry telemetry_;
  MotorPower motors_;
  Spindle spindle_;
  ZAxis z_;
  MotionDoor door_;
  NewValues new_values_;
  SettingsLines settings_lines_;
  Coordinates coordinates_;
  OperatorLines operator_lines_;
  Pauses pauses_;
  Moves moves_;
  Drilling drilling_;
  SingleAxis single_axis_;
  AxisTests axis_tests_;
  YieldNotice yield_notice_;
  uint8_t ticks_per_second_ = 100;
  bool is_status_due_ = false;   ///< a `?` came
  bool is_new_to_grbl_ = false;  ///< a sender of Grbl has asked for the first time
  bool is_sure_ = false;         ///< it has asked again, or in words
  bool is_executing_ = false;    ///< a line of a program is in execution
  uint8_t dropped_jogs_ = 0;     ///< lines that waited then
  volatile bool hung_ = false;
};

}  // namespace machine
