// Holds and pauses, and what the operator may do while the program waits: move z, ask questions,
// resume.
#pragma once

#include "coordinates.h"
#include "motor_power.h"
#include "z_axis.h"

namespace machine {

/// Serves a hold or a pause from its beginning until z is back at the program's height.
///
/// A sender that runs ahead, or has not noticed yet, may have sent lines of its program. So the
/// operator's lines have their own buffer: it takes what comes after the first moments of a hold or
/// pause, and waiting program lines stay as they are. Each operator's line is run at once, or
/// refused with the reason, and never run later.
class OperatorLines {
 public:
  explicit OperatorLines(Parts& parts);

  /// 0x84: everything brakes and the program waits.
  void hold() {
    stale_ = typed_.lines();
    wait(Event::kHold);
  }
  /// `~`.
  void resume();
  // Pauses of the program. Each waits for queued moves and for the end of a hold first, and returns
  // false after a stop.
  /// M0 and M1.
  bool pauseAfterMoves();
  /// M6.
  bool changeTool(uint16_t tool);
  /// Asks the operator to bring z to a height [mm]; afterwards z counts as there. The spindle
  /// stands meanwhile, unless the bit goes into the work.
  bool setZByHand(float z, bool into_work);
  /// A stop: forgets the operator's lines.
  void clear() {
    typed_.clear();
    stale_ = 0;
  }
  /// The buffer for the line that a character belongs to.
  gcode::Input& inputFor(char character);
  /// To be called often: runs a line of the operator, or a step of z's way back.
  void serve();
  /// Whether a line may be done while the program waits.
  bool isForOperator(const char* line) const;

 private:
  /// [ms] A second `~` within this time counts as the same press.
  enum : uint16_t { kTwice = 1000 };

  bool isForOperator(const gcode::Piece& piece) const;
  void wait(Event event);
  bool pause();
  bool isOperatorsTurn() const;
  void comeBack();
  // Not inline: else every wait of the main program would have this line's stack.
  __attribute__((noinline)) void serveLine();
  bool runOrRefuse(const char* line);
  bool run(const char* line);
  bool jogZ(const gcode::Words& words);

  Parts& parts_;
  gcode::Input typed_;                          ///< the operator's lines
  gcode::Input* coming_;                        ///< the buffer of the last line
  gcode::Modal program_;                        ///< modes of the program, restored at the end
  uint8_t stale_ = 0;                           ///< lines that waited when a hold came
  uint32_t since_ms_ = 0;                       ///< when the wait began
  uint32_t resumed_ms_ = uint32_t(0) - kTwice;  ///< when the last `~` came
};

}  // namespace machine
