// What a line of text asks about the machine; knows no serial port and no kinematics.
#pragma once

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

/// A question with its two numbers.
struct Question {
  enum Kind : uint8_t { kUnclear, kLengths, kPlace } kind;
  float first, second;  ///< [mm] x and y, or the left and the right chain
};

/// Beyond this [mm] a number is taken for a mistake: no machine is 100 m wide.
const float kFarthest = 1e5f;

inline bool isBlank(char c) { return c == ' ' || c == '\t'; }

/// Reads ` number number` and nothing else.
inline bool readPair(const char* text, Question& question) {
  if (!isBlank(*text)) return false;
  char* end;
  question.first = float(strtod(text, &end));
  if (end == text || !isBlank(*end)) return false;
  const char* const between = end;
  question.second = float(strtod(between, &end));
  if (end == between) return false;
  while (isBlank(*end)) ++end;
  // False for a NaN, too.
  return *end == '\0' && fabs(question.first) < kFarthest && fabs(question.second) < kFarthest;
}

/// `L x y` or `P left right`; anything else is unclear.
inline Question readQuestion(const char* text) {
  Question question = {Question::kUnclear, 0, 0};
  const char letter = *text;
  if ((letter == 'L' || letter == 'P') && readPair(text + 1, question))
    question.kind = letter == 'L' ? Question::kLengths : Question::kPlace;
  return question;
}
