// Characters from the computer: quick characters are reported at once, the others wait as lines.
#pragma once

#include <stdint.h>

namespace gcode {

/// Meaning of a character.
enum class Quick : uint8_t {
  kNone,
  kStop,            ///< `!`
  kResume,          ///< `~`
  kReset,           ///< ctrl-X or a backquote
  kOverflow,        ///< the room for waiting lines was full: an ordinary character was lost
  kStatus,          ///< `?` outside a comment
  kHold,            ///< 0x84
  kJogCancel,       ///< 0x85
  kFeedUsual,       ///< 0x90: the program's feeds, unchanged
  kFeedUp,          ///< 0x91: 10 percent more
  kFeedDown,        ///< 0x92: 10 percent less
  kFeedUpOne,       ///< 0x93: 1 percent more
  kFeedDownOne,     ///< 0x94: 1 percent less
  kRapidFull,       ///< 0x95: G0 at its full speed
  kRapidHalf,       ///< 0x96
  kRapidQuarter,    ///< 0x97
  kNoOverride,      ///< 0x98 means nothing
  kSpindleUsual,    ///< 0x99: the program's S, unchanged
  kSpindleUp,       ///< 0x9A: 10 percent more
  kSpindleDown,     ///< 0x9B: 10 percent less
  kSpindleUpOne,    ///< 0x9C: 1 percent more
  kSpindleDownOne,  ///< 0x9D: 1 percent less
};

/// Room for 129 waiting characters. Maslow clients rely on 126, Grbl senders on 128.
///
/// Only the main program uses it. The line that comes in is in one of the states of Line.
/// A line of more than 126 characters is dropped to its end; a mark waits in its place, and
/// wasTooLong() is true once that was taken.
class Input {
 public:
  enum : uint8_t { kRoom = 129, kLongestLine = 126 };

  /// Takes a character.
  Quick put(char character);

  /// Free characters in the report for Maslow clients: at most 127.
  uint8_t room() const { return used_ > kTold ? 0 : uint8_t(kTold - used_); }

  /// Whether a line has begun and not yet ended.
  bool isInLine() const { return line_ != Line::kBegins; }

  /// How many complete lines wait.
  uint8_t lines() const { return lines_; }

  /// Takes the oldest line, without its end; false if none is complete.
  bool takeLine(char (&line)[kRoom + 1]);

  /// Whether the last line taken was too long to keep.
  bool wasTooLong() const { return was_too_long_; }

  /// Whether a `~` came after the line taken last, perhaps long before that line was taken. A `~`
  /// counts once, and never for a line that ended after it.
  bool takeResume();

  /// Forgets everything that waits. A line that has begun is dropped up to its end: its rest alone
  /// could be read as another line.
  void clear();

 private:
  enum : uint8_t { kTold = kLongestLine + 1 };

  /// The line that comes in.
  enum class Line : uint8_t {
    kBegins,   ///< nothing of it has come
    kWords,    ///< words are coming
    kComment,  ///< in a comment that `)` ends
    kRemark,   ///< behind a `;`, which ends with the line
    kTooLong,  ///< it does not fit and is skipped to its end
    kCut,      ///< clear() came inside it: it is dropped to its end
  };

  static uint8_t after(uint8_t at) { return at == kRoom - 1 ? 0 : uint8_t(at + 1); }
  Quick quickOf(char character);
  bool isText() const { return line_ == Line::kComment || line_ == Line::kRemark; }
  Quick endLine();
  /// Takes a character that belongs to a line.
  Quick take(char character);
  void store(char character);
  /// Stores an ordinary character, or skips a line that is too long.
  Quick keep(char character);

  char ring_[kRoom];
  uint8_t first_ = 0, used_ = 0, lines_ = 0;
  uint8_t resumable_ = 0;  ///< lines before the last `~`: the line taken last, and waiting lines
  Line line_ = Line::kBegins;
  bool after_quick_ = false, was_too_long_ = false;
  bool after_return_ = false;  ///< a CR ended a line: an LF right after it belongs to it
};

}  // namespace gcode
