// Lines about settings for the client: a line of the dump, and why a value was refused.
#pragma once

#include "format.h"
#include "values.h"

namespace settings {

/// Calls put(char) for each letter of a text.
template <class Put>
void putText(const char* text, Put& put) {
  for (; *text; ++text) put(*text);
}

template <class Put>
void putNumber(float value, Put& put) {
  putText(formatValue(value).text, put);
}

template <class Put>
void putWord(const Table& table, Word which, Put& put) {
  for (uint8_t i = 0; const char letter = table.word(which, i); ++i) put(letter);
}

/// `$n=value (comment)`, without the line's end. The caller leaves out rows that are not listed.
/// Numbers count from `first`.
template <class Put>
void putSetting(const Values& values, uint8_t index, uint16_t first, Put& put) {
  const Table& table = values.table();
  put('$');
  putNumber(float(first + table.at(index).number), put);
  put('=');
  putNumber(values.at(index), put);
  put(' ');
  put('(');
  for (uint8_t i = 0; const char letter = table.comment(index, i); ++i) put(letter);
  put(')');
}

/// Why `$number=value` was not taken: the text that follows `error: `, without the line's end.
/// Numbers count from `first`.
template <class Put>
void putRefusal(const Table& table, uint8_t number, Refusal why, uint16_t first, Put& put) {
  put('$');
  putNumber(float(first + number), put);
  put(' ');
  if (why < Refusal::kOutOfRange) return putWord(table, Word(uint8_t(why) - 1), put);
  const Entry entry = table.at(indexOf(table, number));
  putWord(table, Word::kFrom, put);
  putNumber(entry.low, put);
  putWord(table, Word::kTo, put);
  putNumber(entry.high, put);
  if (entry.step == 1) putWord(table, Word::kWhole, put);
  if (entry.step > 1 && entry.step != kAnyButZero) {
    putWord(table, Word::kSteps, put);
    putNumber(entry.step, put);
  }
}

}  // namespace settings
