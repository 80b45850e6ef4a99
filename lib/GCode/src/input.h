// Characters from the computer: quick ones are told at once, the others wait as lines.
#pragma once

#include <stdint.h>

namespace gcode {

/// What a character meant.
enum class Quick : uint8_t {
  kNone,
  kStop,         ///< `!`
  kResume,       ///< `~`
  kReset,        ///< ctrl-X or a backquote
  kOverflow,     ///< no quick character, but the room for waiting lines is full: one was lost
  kHold,         ///< 0x84
  kFeedUsual,    ///< 0x90: the feeds of the program
  kFeedUp,       ///< 0x91: ten percent more
  kFeedDown,     ///< 0x92: ten percent less
  kFeedUpOne,    ///< 0x93: one percent more
  kFeedDownOne,  ///< 0x94: one percent less
};

/// Room for 127 characters that wait, as the clients count on 126.
///
/// Used by the main program alone. A line longer than all of the room is swallowed to its end and
/// later taken as one that is too long.
class Input {
 public:
  enum : uint8_t { kRoom = 127 };

  /// Takes a character.
  Quick put(char character);

  /// Free characters, as the status reports it.
  uint8_t room() const { return uint8_t(kRoom - used_); }

  /// Nothing waits, not even part of a line.
  bool isEmpty() const { return used_ == 0; }

  /// Takes the oldest line, without its end; false if none is complete.
  bool takeLine(char (&line)[kRoom + 1]);

  /// The same, and it stays until dropLine().
  bool peekLine(char (&line)[kRoom + 1]) const;
  void dropLine();

  /// Whether the line taken last had been too long, so that nothing of it is left.
  bool wasTooLong() const { return was_too_long_; }

  /// Whether a `~` came behind the line taken last, perhaps long before that line was taken. It
  /// counts once, and never for a line that ended after it.
  bool takeResume();

  void clear();

 private:
  void store(char character);
  Quick putQuick(char character);

  char ring_[kRoom];
  uint8_t first_ = 0, used_ = 0, lines_ = 0;
  uint8_t resumable_ = 0;  ///< lines in front of the last `~`: the one taken last, and waiting ones
  bool after_quick_ = false, swallowing_ = false, was_too_long_ = false;
  // Where a byte above 127 is text.
  char comment_ = 0;  ///< what began it
  bool after_text_ = false;
};

}  // namespace gcode
