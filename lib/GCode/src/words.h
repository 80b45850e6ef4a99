// A line of text as words: letters with their numbers, and what is wrong with them.
#pragma once

#include <stdint.h>

namespace gcode {

/// Fault of a word.
enum class Fault : uint8_t {
  kNone,
  kNoNumber,   ///< the letter has none
  kBadNumber,  ///< more than one point or sign, an exponent without digits, two numbers in a row
  kTooLarge,   ///< more than a float can hold
  kStray,      ///< a character that begins no word
  kNoCode,     ///< a G or M below zero, beyond 999, or with hundredths
};

/// Removes comments, spaces, `%` and `/`, and makes letters capital. A checksum (`*` and the
/// exclusive or of what stands before it) goes too if it is right, and stays as a mistake if not.
///
/// Where any of these was between two digits, or between a digit and an E, a space stays, so that
/// two numbers never join. It also stays between two letters, so that a line can be quoted.
void clean(char* line);

/// A number as it is written: `digits` times ten to the power of `exponent`.
struct Decimal {
  uint32_t digits;
  int16_t exponent;
  bool is_negative;
};

/// Reads the number at `text` as readNumber() does, but leaves its value to valueOf(): half the
/// work where only mistakes count.
Fault readDecimal(const char*& text, Decimal& decimal);
float valueOf(const Decimal& decimal);

/// A number, and what is wrong with it; its value is zero if anything is.
struct Number {
  float value;
  Fault fault;
};

/// The number at `text`: sign, digits, point, exponent, with any count of digits. Moves `text`
/// behind it. The value is within 1 unit in the last place of the nearest float, within 2 for
/// exponents beyond ten.
Number readNumber(const char*& text);

/// A letter and its number, or what is wrong with them.
struct Word {
  char letter;  ///< for a stray character, that character
  float value;
  Fault fault;
};

/// Reads the word at `text` and moves on; false at the end of the line.
bool readWord(const char*& text, Word& word);

/// The same when only looking for mistakes: just G and M get their values.
bool checkWord(const char*& text, Word& word);

/// Whether a letter begins a command of a line.
inline bool isCode(char letter) { return letter == 'G' || letter == 'M'; }

/// Words by letter; where a letter is used twice, the first word counts.
class Words {
 public:
  Words() { clear(); }

  void clear() {
    for (uint8_t i = 0; i < kBytes; ++i) present_[i] = 0;
  }
  // Always inline: for a letter that is known this is a test of a bit.
  __attribute__((always_inline)) bool has(char letter) const {
    return (present_[byteOf(letter)] & bitOf(letter)) != 0;
  }
  /// The letter's number; zero if the letter is missing or has no number.
  float value(char letter) const { return has(letter) ? value_[letter - 'A'] : 0; }
  bool isEmpty() const { return (present_[0] | present_[1] | present_[2] | present_[3]) == 0; }
  /// Whether the words say where to go: X, Y or Z.
  bool hasPlace() const { return has('X') || has('Y') || has('Z'); }
  void add(char letter, float value);
  void remove(char letter) { present_[byteOf(letter)] &= uint8_t(~bitOf(letter)); }

 private:
  enum : uint8_t { kBytes = 4 };

  static uint8_t byteOf(char letter) { return uint8_t(letter - 'A') >> 3; }
  static uint8_t bitOf(char letter) { return uint8_t(1 << ((letter - 'A') & 7)); }

  uint8_t present_[kBytes];  ///< a bit for each letter, in bytes: the board shifts bit by bit
  float value_[26];
};

}  // namespace gcode
