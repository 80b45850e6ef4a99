// Fixed text that lives in the Mega's flash, not in its scarce RAM.
#pragma once

#include <avr/pgmspace.h>

namespace machine {

/// A text in flash; made by FLASH() or from an array marked PROGMEM.
struct FlashText {
  const char* at;
};

}  // namespace machine

/// A literal as text in flash.
#define FLASH(text)                         \
  ([]() -> machine::FlashText {             \
    static const char kAt[] PROGMEM = text; \
    return machine::FlashText{kAt};         \
  }())
