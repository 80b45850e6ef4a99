// The table of settings in plain memory, with all its texts, for programs on the host.
#pragma once

#include "../../src/settings_effects.h"
#include "../../src/settings_table.h"

namespace settings_host {

/// Texts about a row for people.
struct RowText {
  const char* name;   ///< in C++
  const char* label;  ///< "name, unit"
  const char* key;    ///< section and key of the published programs, or ""
  const char* sentence;
  const char* change;  ///< difference from the published firmware, or ""
};

using namespace settings;

const Entry kRows[] = {PLUMB_ENTRIES};

#define PLUMB_TEXT(name, number, label, kind, step, usual, low, high, touches, key, sentence, \
                   change)                                                                    \
  {#name, label, key, sentence, change},
const RowText kTexts[] = {PLUMB_SETTINGS(PLUMB_TEXT, PLUMB_TEXT, PLUMB_TEXT)};
#undef PLUMB_TEXT

#define PLUMB_WORD(name, text) text,
const char* const kWords[] = {PLUMB_SETTINGS_WORDS(PLUMB_WORD)};
#undef PLUMB_WORD
static_assert(sizeof kWords / sizeof kWords[0] == uint8_t(Word::kCount), "a word is missing");

/// Rows, comments and words.
class PlainTable : public Table {
 public:
  uint8_t count() const override { return kSettingCount; }
  Entry at(uint8_t index) const override {
    if (index >= kFirstPlaceSetting) return placeRow(uint8_t(index - kFirstPlaceSetting));
    return index < kFirstEffectSetting ? kRows[index]
                                       : effectRow(uint8_t(index - kFirstEffectSetting));
  }
  char comment(uint8_t index, uint8_t letter) const override {
    return index < kFirstEffectSetting ? kTexts[index].label[letter] : "effect"[letter];
  }
  char word(Word which, uint8_t letter) const override { return kWords[uint8_t(which)][letter]; }
};

}  // namespace settings_host
