// Kinds of lines, and the numbers of B codes.
#pragma once

#include <avr/pgmspace.h>
#include <string.h>

#include "course.h"

namespace machine {

/// The two digits behind the B, or 255.
inline uint8_t bCodeOf(const char* line) {
  const uint8_t tens = uint8_t(line[1] - '0');
  if (tens > 9) return 255;
  const uint8_t ones = uint8_t(line[2] - '0');
  return ones > 9 ? uint8_t(255) : uint8_t(tens * 10 + ones);
}

/// Codes that ask and change nothing.
inline bool isQuestion(uint8_t code) { return code == 5 || code == 10 || code == 20 || code == 30; }

/// The kind of a line that begins without spaces.
inline Kind kindOf(const char* line) {
  if (*line == 'B' || *line == 'b') return isQuestion(bCodeOf(line)) ? kQuestion : kAct;
  if (*line != '$') return kCode;
  if (strncmp_P(line + 1, PSTR("J="), 2) == 0) return kJog;
  if (line[1] == 'C') return kCheck;
  return strchr(line, '=') == nullptr ? kQuestion : kSetting;
}

/// B17 to B19, which set limits of z and move nothing.
inline bool isZLimitCode(uint8_t code) { return code >= 17 && code <= 19; }

}  // namespace machine
