// A line of text as words: letters with their numbers.
#pragma once

#include <stdint.h>

namespace machine {

/// Removes comments, spaces, `%`, `/` and what is no text, and makes letters capital.
void clean(char* line);

/// A number at `text`: sign, digits, point, exponent, as many as there are. Moves `text` behind it;
/// leaves it alone and answers zero if there is none.
float readNumber(const char*& text);

/// Words by letter; of a letter used twice the first one counts.
class Words {
 public:
  Words() : present_(0) {}

  bool has(char letter) const { return present_ >> (letter - 'A') & 1; }
  /// Its number; zero if the letter is not there or had none.
  float value(char letter) const { return has(letter) ? value_[letter - 'A'] : 0; }
  bool isEmpty() const { return present_ == 0; }
  void add(char letter, float value);

 private:
  uint32_t present_;
  float value_[26];
};

/// A letter and what stands behind it.
struct Word {
  char letter;
  bool has_number;
  float value;
};

/// Reads one word at `text` and moves it on; what begins with no letter is passed over. False at
/// the end.
bool readWord(const char*& text, Word& word);

}  // namespace machine
