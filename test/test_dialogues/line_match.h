// Whether a line is as expected: numbers within a tolerance, everything else the same.
#pragma once

#include <cmath>
#include <cstdlib>
#include <string>

/// An expected line; a `*` at its end stands for any rest, a `#` for any number.
struct Expected {
  std::string text;
  double tolerance = 0;  ///< for each number of the text; zero: letter by letter
};

/// Reads `text` or `text within 0.05`.
inline Expected readExpected(const std::string& words) {
  const std::string kWithin = " within ";
  const std::size_t at = words.rfind(kWithin);
  if (at == std::string::npos) return {words};
  return {words.substr(0, at), std::atof(words.c_str() + at + kWithin.size())};
}

/// Length of the number at the beginning of a text, 0 if there is none; no exponents.
inline std::size_t numberLength(const char* text) {
  const char* at = text;
  if (*at == '-' || *at == '+') ++at;
  const char* const digits = at;
  while (*at >= '0' && *at <= '9') ++at;
  if (at == digits) return 0;
  if (*at == '.')
    for (++at; *at >= '0' && *at <= '9';) ++at;
  return std::size_t(at - text);
}

inline bool matches(const std::string& line, const Expected& expected) {
  const char *got = line.c_str(), *want = expected.text.c_str();
  while (*want != '\0') {
    if (*want == '*' && want[1] == '\0') return true;
    if (*want == '#') {
      if (numberLength(got) == 0) return false;
      got += numberLength(got);
      ++want;
      continue;
    }
    const std::size_t got_digits = expected.tolerance > 0 ? numberLength(got) : 0;
    const std::size_t want_digits = expected.tolerance > 0 ? numberLength(want) : 0;
    if (got_digits != 0 && want_digits != 0) {
      // Written so that a NaN is refused.
      if (!(std::fabs(std::atof(got) - std::atof(want)) <= expected.tolerance)) return false;
      got += got_digits;
      want += want_digits;
    } else if (*got++ != *want++) {
      return false;
    }
  }
  return *got == '\0';
}
