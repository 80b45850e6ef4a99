// Reads words and numbers. The library's strtod would be large, and it reads words like "nan".
#include "words.h"

namespace gcode {
namespace {

bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isLetter(char c) { return c >= 'A' && c <= 'Z'; }
bool endsNumber(char c) { return isDigit(c) || c == '.'; }

const int16_t kMostExponent = 60;  // beyond it the float is zero or infinite in any case
const float kLargest = 3.402823e38f;
const int16_t kSafeExponent = 28;

/// Times or divided by powers of ten; each up to 10^10 is exact.
float scaled(float number, int16_t exponent) {
  const bool divides = exponent < 0;
  int16_t left = divides ? int16_t(-exponent) : exponent;
  if (left > kMostExponent) left = kMostExponent;
  while (left > 0) {
    float power = 10;
    --left;
    for (uint8_t step = 1; step < 10 && left > 0; ++step, --left) power *= 10;
    number = divides ? number / power : number * power;
  }
  return number;
}

/// Digits as they come. Digits beyond what a float can hold only move the point.
struct Digits {
  uint32_t number = 0;
  int16_t exponent = 0;
  bool any = false;

  void take(char digit, bool fraction) {
    any = true;
    if (number < 100000000) {
      number = number * 10 + uint32_t(digit - '0');
      if (fraction) --exponent;
    } else if (!fraction && exponent < 1000) {
      ++exponent;
    }
  }
};

/// Reads an exponent behind an E; false if there is none.
bool readExponent(const char*& text, int16_t& exponent) {
  const char* at = text + 1;
  const bool negative = *at == '-';
  if (*at == '-' || *at == '+') ++at;
  if (!isDigit(*at)) return false;
  int16_t power = 0;
  for (; isDigit(*at); ++at)
    if (power < 1000) power = int16_t(power * 10 + (*at - '0'));
  text = at;
  exponent = int16_t(exponent + (negative ? -power : power));
  return true;
}

/// Whether the text after a number belongs to it, so that the number is wrong.
bool goesOn(const char* text) {
  if (*text == ' ') ++text;
  return endsNumber(*text) || *text == '-' || *text == '+';
}

/// Passes over what looks like a number, so that a mistake is reported once.
Fault broken(const char*& text) {
  while (endsNumber(*text) || *text == '-' || *text == '+' || *text == ' ') ++text;
  return Fault::kBadNumber;
}

/// Reads a word; `with_values`: with the values of all letters, not of codes alone.
bool read(const char*& text, Word& word, bool with_values) {
  while (*text == ' ') ++text;
  if (*text == '\0') return false;
  word = {*text++, 0, Fault::kStray};
  if (!isLetter(word.letter)) return true;
  Decimal decimal;
  word.fault = readDecimal(text, decimal);
  if (word.fault == Fault::kNone && (with_values || isCode(word.letter)))
    word.value = valueOf(decimal);
  return true;
}

/// Whether a space between these characters means something: two numbers that must not join, or a
/// letter without its number.
bool staysApart(char before, char after) {
  return endsNumber(before) ? endsNumber(after) || after == 'E'
                            : isLetter(before) && isLetter(after);
}

/// Whether `star` begins the checksum of its line: the exclusive or of all characters before it.
bool beginsChecksum(const char* line, const char* star) {
  uint8_t sum = 0;
  uint16_t stated = 0;
  for (; line != star; ++line) sum ^= uint8_t(*line);
  const char* at = star + 1;
  for (; isDigit(*at) && stated < 256; ++at) stated = uint16_t(10 * stated + (*at - '0'));
  while (*at == ' ') ++at;
  return at != star + 1 && *at == '\0' && stated == sum;
}

}  // namespace

void clean(char* line) {
  char* to = line;
  bool gap = false;
  // Before anything is written: the checksum is that of the line as it came.
  const char* end = line;
  for (bool is_comment = false; *end != '\0'; ++end) {
    is_comment = *end == '(' || (is_comment && *end != ')');
    if (!is_comment && (*end == ';' || (*end == '*' && beginsChecksum(line, end)))) break;
  }
  for (const char* at = line; at < end; ++at) {
    const char c = *at >= 'a' && *at <= 'z' ? char(*at - 'a' + 'A') : *at;
    if (c == '(') {
      while (*at != ')' && *at != '\0') ++at;
      if (*at == '\0') break;
    }
    if (c == '(' || c <= ' ' || c == '%' || c == '/') {
      gap = true;
      continue;
    }
    if (gap && to != line && staysApart(to[-1], c)) *to++ = ' ';
    gap = false;
    *to++ = c;
  }
  *to = '\0';
}

Fault readDecimal(const char*& text, Decimal& decimal) {
  const char* at = text;
  decimal.is_negative = *at == '-';
  if (*at == '-' || *at == '+') ++at;
  Digits digits;
  for (; isDigit(*at); ++at) digits.take(*at, false);
  if (*at == '.')
    for (++at; isDigit(*at); ++at) digits.take(*at, true);
  if (!digits.any) return at == text ? Fault::kNoNumber : broken(text);
  if (*at == 'E' && !readExponent(at, digits.exponent)) return broken(text = at + 1);
  if (goesOn(at)) return broken(text);
  text = at;
  decimal.digits = digits.number;
  decimal.exponent = digits.exponent;
  // Nine digits with a smaller exponent always fit.
  const bool is_large = digits.exponent > kSafeExponent;
  if (is_large && !(scaled(float(digits.number), digits.exponent) <= kLargest))
    return Fault::kTooLarge;
  return Fault::kNone;
}

float valueOf(const Decimal& decimal) {
  const float value = scaled(float(decimal.digits), decimal.exponent);
  return decimal.is_negative ? -value : value;
}

Number readNumber(const char*& text) {
  Decimal decimal;
  const Fault fault = readDecimal(text, decimal);
  return {fault == Fault::kNone ? valueOf(decimal) : 0, fault};
}

bool readWord(const char*& text, Word& word) { return read(text, word, true); }

bool checkWord(const char*& text, Word& word) { return read(text, word, false); }

void Words::add(char letter, float value) {
  if (has(letter)) return;
  present_[byteOf(letter)] |= bitOf(letter);
  value_[letter - 'A'] = value;
}

}  // namespace gcode
