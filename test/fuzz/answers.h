// Counts the answers that the machine owes the computer, and checks each line that it sends.
#pragma once

#include <cstdint>
#include <string>

/// What clients rely on: an answer for each line and each quick character, but none for a line that
/// a stop broke off, and none for a `~` that ends a hold by 0x84. In a pause, or too late to hold
/// anything, 0x84 holds nothing, and the `~` behind it has its answer.
///
/// A Grbl sender gets an answer for each line, also after an alarm, and none for quick characters.
/// Only the line in which an alarm comes may have none.
class Answers {
 public:
  /// The machine took a character from the wire.
  void taken(char character);
  /// The machine sent a line.
  void said(const std::string& line);
  /// A round of the main program is over.
  void wentRound();
  /// Power came back, and the greeting is over.
  void startAnew() { *this = Answers(); }

  bool isComplete() const { return answered_ >= lines_ + quick_ - broken_; }
  bool isOfGrbl() const { return is_of_grbl_; }
  /// Whether the dialect that the machine will use is unknown from outside, and from when on.
  bool isUnclear() const { return is_unclear_; }
  bool isLocked() const { return is_locked_; }
  /// After a halt the moves before it are finished; after an alarm nothing turns.
  bool mayDrive() const { return is_unclear_ || !is_locked_ || is_halted_; }
  /// Whether the last status says so, and nothing since could have changed it.
  bool isIdle() const { return is_idle_; }
  bool isSimulated() const { return is_simulated_; }
  /// Settings lines since the last look.
  int takeSettings();

 private:
  void checkLine(const std::string& line);
  void saidToMaslow(const std::string& line);
  void saidToGrbl(const std::string& line);
  void takenByGrbl(char character);
  void dropLines();
  void takenQuick(char character);
  void takenEnd(bool follows_quick);

  long lines_ = 0, quick_ = 0, answered_ = 0, answered_before_ = 0;
  long resumed_ = 0;  ///< `~` behind 0x84, which may have an answer
  long broken_ = 0;   ///< lines that a Grbl alarm may have left without an answer
  int rounds_ = 0, settings_ = 0;
  bool is_of_grbl_ = false;
  bool is_sure_ = false;  ///< a second `?` came, so the first was no noise
  bool is_unclear_ = false, has_space_ = false;
  bool is_in_line_ = false, is_cut_ = false;  ///< part of a line came; its rest is dropped
  bool after_quick_ = false, after_return_ = false, is_locked_ = false, is_halted_ = false,
       is_simulated_ = false;
  // Lines wait without an answer in a hold, and behind it while z goes back: until a status no
  // longer says so, whatever a second `~` asks for.
  bool is_held_ = false, is_waiting_ = false, is_idle_ = false;
};
