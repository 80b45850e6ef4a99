// The list of settings. The code here works on any table; only published.h names settings, those of
// the published firmware.
#pragma once

#include <stdint.h>

namespace settings {

/// How the published firmware stored a value, and how it is written as text.
enum class Kind : uint8_t { kBool, kByte, kWord, kReal };

/// Whether a client may see and set a number.
enum class Access : uint8_t {
  kListed,  ///< in the dump, and set by $n=value
  kHidden,  ///< stored like any other setting, but only the machine's commands set it
  kKept,    ///< hidden, and only a reset of everything changes it
};

/// In place of a step: any value within the limits, or any value but zero.
enum : uint8_t { kAnyValue = 0, kAnyButZero = 255 };

/// Parts that a new value touches, as bits: the machine works them out again before the value
/// counts everywhere. This library uses kScale alone; the machine uses the rest.
enum Touch : uint8_t {
  kNothing = 0,   ///< it is read where it is used, from the next line on
  kScale = 1,     ///< how many counts a length has
  kGeometry = 2,  ///< where the sled hangs on its chains, or where it may hang
  kLoops = 4,     ///< gains and watch of the control loops
  kLimits = 8,    ///< speeds, accelerations and corners of moves
  kDrives = 16,   ///< how motors and encoders are driven and read
  kCutter = 32,   ///< which pins switch spindle and laser, and how
  kRestart = 64,  ///< it is read only at the start
};

/// A row: what a setting may hold.
struct Entry {
  uint8_t number;  ///< the n of $n
  Kind kind;
  Access access;
  uint8_t step;     ///< whole values count from low in steps of this; or kAnyValue, kAnyButZero
  uint8_t touches;  ///< bits of Touch
  float usual;      ///< the default
  float low, high;
};

/// Texts that belong to a table.
enum class Word : uint8_t {
  // Follow "$n ": why a value is refused.
  kUnknown,   ///< it is not a setting
  kHidden,    ///< other commands set it
  kNoNumber,  ///< the value is not a number
  kZero,      ///< it cannot be zero
  kFrom,      ///< before the lowest value
  kTo,        ///< between the lowest and the highest
  kWhole,     ///< after the limits: whole numbers only
  kSteps,     ///< after the limits: before the step
  kCount
};

/// The settings, their comments for the dump, and texts for refusals. Numbers rise from row to row.
/// The board has all of it in flash; this interface hides how flash is read.
class Table {
 public:
  virtual uint8_t count() const = 0;
  virtual Entry at(uint8_t index) const = 0;
  /// A letter of the row's comment; 0 after the last.
  virtual char comment(uint8_t index, uint8_t letter) const = 0;
  /// A letter of a text; 0 after the last.
  virtual char word(Word which, uint8_t letter) const = 0;

 protected:
  ~Table() {}
};

/// No row: the answer of a search without a result.
const uint8_t kNoIndex = 255;

/// The row with that $-number, or kNoIndex; half a millisecond on the board.
uint8_t indexOf(const Table& table, uint8_t number);

}  // namespace settings
