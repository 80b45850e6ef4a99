// Characters gathered into one line of bounded length; knows no serial port.
#pragma once

#include <stdint.h>

/// A line that grows by characters; what is beyond its bound is dropped, and remembered as too
/// long.
class Line {
 public:
  enum : uint8_t { kMost = 40 };

  /// Takes the next character; true when it ends a line that is not empty.
  bool add(char c) {
    if (c == '\n' || c == '\r') return used_ != 0;
    // A zero, which only noise sends, must not look like the end of the text.
    if (used_ < kMost) text_[used_] = c == '\0' ? '?' : c;
    if (used_ <= kMost) ++used_;
    return false;
  }

  bool tooLong() const { return used_ > kMost; }

  /// The finished line.
  const char* text() {
    text_[tooLong() ? uint8_t(kMost) : used_] = '\0';
    return text_;
  }

  /// Makes ready for the next line.
  void clear() { used_ = 0; }

 private:
  char text_[kMost + 1];
  uint8_t used_;  // kMost + 1 when there were more
};
