// The painted bytes. Nothing else is there, as the firmware has no heap.
#include "stack_guard.h"

#include <stdint.h>

/// The first byte above the program's data, by the linker.
extern "C" volatile uint8_t __heap_start;

namespace board {
namespace {

const uint8_t kBytes = 32;  // a call of any function writes into the last 32
const uint8_t kPaint = 0xa5;

}  // namespace

void stack_guard::paint() {
  for (uint8_t i = 0; i < kBytes; ++i) (&__heap_start)[i] = kPaint;
}

bool stack_guard::isWhole() {
  for (uint8_t i = 0; i < kBytes; ++i)
    if ((&__heap_start)[i] != kPaint) return false;
  return true;
}

}  // namespace board
