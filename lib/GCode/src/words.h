// A line of text as words: letters with their numbers, and what is wrong with them.
#pragma once

#include <stdint.h>

namespace gcode {

/// What is wrong with a word.
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

/// Words by letter; where a letter is used twice, the first word counts.
class Words {
 public:
  Words() : present_(0) {}

  bool has(char letter) const { return present_ >> (letter - 'A') & 1; }
  /// The letter's number; zero if the letter is missing or has no number.
  float value(char letter) const { return has(letter) ? value_[letter - 'A'] : 0; }
  bool isEmpty() const { return present_ == 0; }
  /// Whether the words say where to go: X, Y or Z.
  bool hasPlace() const { return has('X') || has('Y') || has('Z'); }
  void add(char letter, float value);
  void remove(char letter) { present_ &= ~(uint32_t(1) << (letter - 'A')); }

 private:
  uint32_t present_;
  float value_[26];
};

}  // namespace gcode
