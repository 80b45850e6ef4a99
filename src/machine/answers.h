// The answer to a line: `ok`, `error:`, or the alarm that halts the machine.
#pragma once

#include <GCode.h>

#include "printer.h"
#include "settings_table.h"

namespace machine {

/// The answer to the line in execution; each line gets at most one answer.
///
/// A client sends its next line after `error:` just as after `ok`. After a refused move the next
/// move would start from a wrong place. So by default a refused move halts the machine ($70):
/// mustHalt() is then true once. Functions that refuse return false, so a command can return their
/// result.
///
/// A Grbl sender gets a mistake in a line as `error:N`, and a motion that cannot be done as
/// `ALARM:2`, each with the text before it.
class Answers {
 public:
  Answers(Printer& out, const settings::Values& values) : out_(out), values_(values) {}

  /// Begins a new line. If it halts the machine, the alarm quotes `line`.
  void begin(const char* line) {
    line_ = line;
    is_answered_ = false;
  }
  bool isAnswered() const { return is_answered_; }
  /// Sets whether the line counts as answered.
  void setAnswered(bool yes) { is_answered_ = yes; }
  /// Sets whether a refusal may halt the machine. For a line of the operator it may not, because no
  /// program depends on it.
  void serve(bool yes) { is_serving_ = yes; }
  /// Whether a line of the operator is in execution.
  bool isServing() const { return is_serving_; }
  /// Whether a refusal has asked for a halt since the last call.
  bool mustHalt() {
    const bool must = must_halt_;
    must_halt_ = false;
    return must;
  }

  /// Begins the text of a refusal; the caller ends the line. `number` is Grbl's error number.
  void beginError(uint8_t number = grbl::kStatement);
  bool refuse(FlashText why, uint8_t number = grbl::kStatement);
  /// Refuses a line without a text, as a Grbl sender expects.
  bool refuseBare(uint8_t number);
  /// Refuses a motion that cannot be done, so that the machine is not where the program thinks:
  /// asks for a halt or answers `error:`, as setting $70 says.
  /// The sentence ends in `letter`, if there is one.
  bool refuseMotion(FlashText why, char letter = '\0') {
    return refuseLine(true, grbl::kTravel, why, letter);
  }
  /// Refuses a line that makes no sense; asks for a halt as above.
  bool refuseWords(FlashText why, char letter = '\0') {
    return refuseLine(false, grbl::kUnsupported, why, letter);
  }
  /// Refuses a motion with a sentence around a length [mm].
  bool refuseMotion(FlashText why, float mm, FlashText more);
  /// Refuses an unknown line with the published firmware's message.
  bool refuseStatement();
  bool refuseMistake(gcode::Mistake mistake);
  bool refuseCode(const gcode::Piece& piece);

 private:
  bool halts() const { return values_.at(kRefusedMotion) == 0 && !is_serving_; }
  bool refuseLine(bool is_motion, uint8_t number, FlashText why, char letter);
  void beginRefusal(bool is_motion, uint8_t number);
  bool endRefusal();
  void quoteLine();

  Printer& out_;
  const settings::Values& values_;
  const char* line_ = "";
  bool is_answered_ = false, must_halt_ = false, is_serving_ = false;
};

// Refusals used in more than one place.
FlashText tooLongForChains();
FlashText tooLongForZ();
FlashText tooFar();
FlashText tooLongALine();

}  // namespace machine
