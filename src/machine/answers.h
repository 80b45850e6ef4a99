// What a line is answered with: `ok`, `error:`, or the alarm that halts the machine.
#pragma once

#include <GCode.h>

#include "printer.h"
#include "settings_table.h"

namespace machine {

/// The answer to the line in execution; each line gets one at most.
///
/// A client sends its next line after `error:` as after `ok`. A move that is not done would let the
/// next one start from a wrong place, so by default it halts the machine instead ($70): then
/// mustHalt() is true once. All that refuses returns false, so that a command can return it.
class Answers {
 public:
  Answers(Printer& out, const settings::Values& values) : out_(out), values_(values) {}

  /// A new line is in execution; `line` is named when it halts the machine.
  void begin(const char* line) {
    line_ = line;
    is_answered_ = false;
  }
  bool isAnswered() const { return is_answered_; }
  /// Says whether the line counts as answered.
  void setAnswered(bool yes) { is_answered_ = yes; }
  /// Whether a refusal has asked for a halt since this was last asked.
  bool mustHalt() {
    const bool must = must_halt_;
    must_halt_ = false;
    return must;
  }

  /// Begins a line with `error: `, to be ended by the caller.
  void beginError();
  bool refuse(FlashText why);
  /// For whatever leaves the machine where the program does not think it is: halts it, or answers
  /// `error:`, by setting $70.
  bool refuseMotion(FlashText why);
  /// The same; `letter` ends the sentence.
  bool refuseMotion(FlashText why, char letter);
  /// What the published firmware says to a line that it cannot make sense of.
  bool refuseStatement();
  bool refuseMistake(gcode::Mistake mistake);
  bool refuseCode(const gcode::Piece& piece);

 private:
  bool halts() const { return values_.at(kRefusedMotion) == 0; }
  void beginRefusal();
  bool endRefusal();
  void beginHalt();

  Printer& out_;
  const settings::Values& values_;
  const char* line_ = "";
  bool is_answered_ = false, must_halt_ = false;
};

// What more than one part refuses.
FlashText tooLongForChains();
FlashText tooLongForZ();
FlashText tooFar();

}  // namespace machine
