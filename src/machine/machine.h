// The machine: how lines from the computer move the motors, and every answer to them. Without
// Arduino: ports.h holds what it needs of a board. parts.h says which part uses which.
#pragma once

#include "b_codes.h"
#include "codes.h"
#include "grbl_front.h"

namespace machine {

/// A Maslow: its parts, the main program, and which part runs which line.
///
/// Commands run to their end in the main program. While a command waits, service() keeps everything
/// else going (waiting.h). Functions that may wait return whether they were completed.
class Machine : private Waiting {
 public:
  Machine(const Ports& ports, const BoardName& board);

  /// To be called once after power-on: reads settings and position, and says the greeting.
  __attribute__((noinline)) void begin();

  /// A round of the main program: executes at most one line.
  void loop();

  /// The control tick. An interrupt calls it 100 or 200 times a second.
  void tick() {
    parts_.axes.tick();
    parts_.cutter.show(parts_.axes.beam());
  }

  /// Called in place of tick() while the main program hangs. The board has taken the power off the
  /// motors.
  void noteHang() { stops_.noteHang(); }

  /// How often the machine needs its control tick; known after begin().
  uint8_t ticksPerSecond() const { return ticks_per_second_; }

  /// For dry runs.
  const Parts& parts() const { return parts_; }

 private:
  // What goes on while anything waits.
  void service() override;
  __attribute__((noinline)) void keepReporting();
  void readWire();
  void takeQuick(gcode::Quick quick);
  void resetSoftly();
  bool isFarAhead() const;

  // What is done with a line.
  __attribute__((noinline)) bool execute(char* line);
  bool mayRun(Kind kind) const;
  bool refuseNow(Kind kind);
  void answer(bool done) override;
  void echo(const char* line);
  bool runQuestion(const char* line) override;

  Parts parts_;
  Stops stops_;
  Codes codes_;
  BCodes b_codes_;
  GrblFront grbl_;
  uint8_t ticks_per_second_ = 100;
  bool is_executing_ = false;  ///< a line of a program is in execution
};

}  // namespace machine
