// Reads words and numbers without the library's strtod, which cannot tell X1E5 from a feed.
#include "words.h"

namespace machine {
namespace {

bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isLetter(char c) { return c >= 'A' && c <= 'Z'; }

const int16_t kMostExponent = 60;  // beyond it the float is zero or infinite in any case

/// Times or divided by powers of ten; each up to 10^10 is exact.
float scaled(float number, int16_t exponent) {
  if (exponent > kMostExponent) exponent = kMostExponent;
  if (exponent < -kMostExponent) exponent = -kMostExponent;
  for (; exponent > 0; --exponent) number *= 10;
  while (exponent < 0) {
    float power = 1;
    int16_t step = 0;
    for (; step < 10 && exponent < 0; ++step, ++exponent) power *= 10;
    number /= power;
  }
  return number;
}

/// Digits as they come; those beyond what a float can hold only move the point.
struct Digits {
  uint32_t number = 0;
  int16_t exponent = 0;
  bool any = false;

  void take(char digit, bool fraction) {
    any = true;
    if (number < 100000000) {
      number = number * 10 + uint32_t(digit - '0');
      if (fraction) --exponent;
    } else if (!fraction && exponent < kMostExponent) {
      ++exponent;
    }
  }
};

/// An exponent at `text`, if letters and digits make one.
int16_t readExponent(const char*& text) {
  if (*text != 'E') return 0;
  const char* at = text + 1;
  const bool negative = *at == '-';
  if (*at == '-' || *at == '+') ++at;
  if (!isDigit(*at)) return 0;
  int16_t exponent = 0;
  for (; isDigit(*at); ++at)
    if (exponent < 1000) exponent = int16_t(exponent * 10 + (*at - '0'));
  text = at;
  return negative ? int16_t(-exponent) : exponent;
}

}  // namespace

void clean(char* line) {
  char* to = line;
  for (const char* at = line; *at != '\0' && *at != ';'; ++at) {
    if (*at == '(') {
      while (*at != ')' && *at != '\0') ++at;
      if (*at == '\0') break;
    } else if (*at > ' ' && *at < 127 && *at != '%' && *at != '/') {
      *to++ = *at >= 'a' && *at <= 'z' ? char(*at - 'a' + 'A') : *at;
    }
  }
  *to = '\0';
}

float readNumber(const char*& text) {
  const char* at = text;
  const bool negative = *at == '-';
  if (*at == '-' || *at == '+') ++at;
  Digits digits;
  for (; isDigit(*at); ++at) digits.take(*at, false);
  if (*at == '.')
    for (++at; isDigit(*at); ++at) digits.take(*at, true);
  if (!digits.any) return 0;
  const int16_t exponent = readExponent(at);
  text = at;
  const float number = scaled(float(digits.number), int16_t(digits.exponent + exponent));
  return negative ? -number : number;
}

void Words::add(char letter, float value) {
  if (has(letter)) return;
  present_ |= uint32_t(1) << (letter - 'A');
  value_[letter - 'A'] = value;
}

bool readWord(const char*& text, Word& word) {
  while (*text != '\0' && !isLetter(*text)) ++text;
  if (*text == '\0') return false;
  word.letter = *text++;
  const char* const number = text;
  word.value = readNumber(text);
  word.has_number = text != number;
  return true;
}

}  // namespace machine
