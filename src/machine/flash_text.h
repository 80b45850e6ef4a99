// Fixed text in the Mega's flash, which saves its scarce RAM.
#pragma once

#include <avr/pgmspace.h>

namespace machine {

/// A text in flash. FLASH() makes it, or an array marked PROGMEM.
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
