// Text and numbers to the computer; lines look and end as the sender needs it.
#pragma once

#include "flash_text.h"
#include "ports.h"

namespace machine {

/// Grbl's numbers of refusals and alarms.
namespace grbl {
enum : uint8_t {
  kNoLetter = 1,
  kBadNumber = 2,
  kStatement = 3,
  kNoHoming = 5,
  kNotIdle = 8,
  kLocked = 9,
  kLongLine = 11,
  kTravel = 15,
  kBadJog = 16,
  kUnsupported = 20,
  kNoFeed = 22,
};
enum : uint8_t { kAlarmOfTarget = 2, kAlarmOfFault = 3 };
}  // namespace grbl

/// The dialect of the connected program.
enum class Dialect : uint8_t {
  kMaslow,  ///< GroundControl and WebControl
  kGrbl,    ///< a sender that asks with `?`
};

/// Writes to the wire. Nothing is buffered here, so begin a line only when all of it is known.
///
/// A line is one of three kinds. Data begin with `[`, `<` or `$` and are the same in both dialects,
/// as are plain lines. A refusal or an alarm has its words behind `error: ` or `ALARM: `; a sender
/// of Grbl gets the words as `[MSG:...]`, and then `error:N` or `ALARM:N`. Everything else is for
/// people; a Grbl sender gets it as `[MSG:...]`.
class Printer {
 public:
  explicit Printer(Wire& wire) : wire_(wire) {}

  void speak(Dialect dialect) { dialect_ = dialect; }
  bool speaksGrbl() const { return dialect_ == Dialect::kGrbl; }

  /// Begins the text of a refusal or an alarm; end() ends it. The number is Grbl's.
  Printer& error(uint8_t number) { return begin(FLASH("error: "), FLASH("error:"), number); }
  Printer& alarm(uint8_t number) { return begin(FLASH("ALARM: "), FLASH("ALARM:"), number); }
  /// How to get out of a halt, as a sentence.
  FlashText toOpen() const { return speaksGrbl() ? FLASH("Unlock ($X)") : FLASH("Press Stop"); }
  /// The same inside a sentence.
  FlashText alsoToOpen() const { return speaksGrbl() ? FLASH("unlock ($X)") : FLASH("press Stop"); }
  /// A whole line that is the same in both dialects.
  void plain(FlashText text);
  /// `error:N` without words, for a Grbl sender.
  void bareError(uint8_t number) { sayVerdict(FLASH("error:"), number); }

  Printer& operator<<(FlashText text);
  Printer& operator<<(const char* text);
  Printer& operator<<(char character);
  Printer& operator<<(int32_t number);

  /// A number with up to 4 `decimals`, rounded, never with an exponent. A NaN, or a number too
  /// large for any machine, shows as zero: clients stop at words such as "nan".
  Printer& fixed(float number, uint8_t decimals);

  /// Ends the line. A Grbl sender gets no empty lines.
  void end();

  /// A whole line of fixed text.
  void line(FlashText text);

 private:
  /// Written part of the line in progress.
  enum class Line : uint8_t { kNothing, kData, kMessage };

  Printer& begin(FlashText words, FlashText verdict, uint8_t number);
  void beginMessage();
  void putText(FlashText text);
  void endOnWire();
  void sayVerdict(FlashText verdict, uint8_t number);

  Wire& wire_;
  Dialect dialect_ = Dialect::kMaslow;
  Line line_ = Line::kNothing;
  FlashText verdict_ = FLASH("");  ///< what follows a message: `error:` or `ALARM:`
  uint8_t number_ = 0;             ///< its number; 0: nothing follows
};

/// Writes the digits of a number that cannot be negative, with a zero at the end and a point before
/// the last `decimals`. Returns their beginning in `room`.
const char* digitsOf(uint32_t number, char (&room)[12], uint8_t decimals = 0);

}  // namespace machine
