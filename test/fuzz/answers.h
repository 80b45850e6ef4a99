// Counts which answers are owed to the computer, and looks at each line that is sent to it.
#pragma once

#include <string>

/// What clients rely on: one answer for each line and quick character, none for what a stop broke
/// off.
class Answers {
 public:
  /// The machine took a character from the wire.
  void taken(char character);
  /// The machine sent a line.
  void said(const std::string& line);
  /// One round of the main program is over.
  void wentRound();
  /// Power came back, and the greeting is over.
  void startAnew() { *this = Answers(); }

  bool isComplete() const { return answered_ == lines_ + quick_; }
  bool isLocked() const { return is_locked_; }
  /// A halt lets the moves before it come to their end, an alarm lets nothing turn.
  bool mayDrive() const { return !is_locked_ || is_halted_; }
  bool isSimulated() const { return is_simulated_; }
  bool isPaused() const { return is_paused_; }
  /// Settings lines since the last look.
  int takeSettings();

 private:
  void dropLines() { lines_ = answered_ - quick_; }

  long lines_ = 0, quick_ = 0, answered_ = 0, answered_before_ = 0;
  int rounds_ = 0, settings_ = 0;
  bool after_quick_ = false, is_locked_ = false, is_halted_ = false, is_simulated_ = false,
       is_paused_ = false;
};
