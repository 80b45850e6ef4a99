// The table of settings in the board's flash.
#pragma once

#include <avr/pgmspace.h>

#include "settings_effects.h"
#include "settings_table.h"

namespace flash_rows {

using namespace settings;

const Entry kRows[] PROGMEM = {PLUMB_ENTRIES};

#define PLUMB_COMMENT(name, number, label, ...) const char name##Comment[] PROGMEM = label;
PLUMB_SETTINGS(PLUMB_COMMENT, PLUMB_COMMENT, PLUMB_COMMENT)
#undef PLUMB_COMMENT
#define PLUMB_COMMENT(name, ...) name##Comment,
const char* const kComments[] PROGMEM = {
    PLUMB_SETTINGS(PLUMB_COMMENT, PLUMB_COMMENT, PLUMB_COMMENT)};
#undef PLUMB_COMMENT
const char kEffectComment[] PROGMEM = "effect";

#define PLUMB_WORD(name, text) const char name##Word[] PROGMEM = text;
PLUMB_SETTINGS_WORDS(PLUMB_WORD)
#undef PLUMB_WORD
#define PLUMB_WORD(name, text) name##Word,
const char* const kWords[] PROGMEM = {PLUMB_SETTINGS_WORDS(PLUMB_WORD)};
#undef PLUMB_WORD
static_assert(sizeof kWords / sizeof kWords[0] == uint8_t(Word::kCount), "a word is missing");

inline char letterOf(const char* text, uint8_t letter) {
  return char(pgm_read_byte(text + letter));
}

inline const char* pointerIn(const char* const* texts, uint8_t index) {
  return static_cast<const char*>(pgm_read_ptr(texts + index));
}

}  // namespace flash_rows

/// Rows, comments and texts, read from flash.
class FlashTable : public settings::Table {
 public:
  uint8_t count() const override { return kSettingCount; }

  settings::Entry at(uint8_t index) const override {
    if (index >= kFirstPlaceSetting) return placeRow(uint8_t(index - kFirstPlaceSetting));
    if (index >= kFirstEffectSetting) return effectRow(uint8_t(index - kFirstEffectSetting));
    settings::Entry entry;
    memcpy_P(&entry, flash_rows::kRows + index, sizeof entry);
    return entry;
  }

  char comment(uint8_t index, uint8_t letter) const override {
    const bool has_comment = index < kFirstEffectSetting;
    return flash_rows::letterOf(has_comment ? flash_rows::pointerIn(flash_rows::kComments, index)
                                            : flash_rows::kEffectComment,
                                letter);
  }

  char word(settings::Word which, uint8_t letter) const override {
    return flash_rows::letterOf(flash_rows::pointerIn(flash_rows::kWords, uint8_t(which)), letter);
  }
};
