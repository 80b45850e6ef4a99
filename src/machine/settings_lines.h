// Lines with a `$` that show or set a value.
#pragma once

#include "new_values.h"

namespace machine {

/// `$$` and `$n=value`.
class SettingsLines {
 public:
  SettingsLines(Basis& basis, NewValues& new_values) : base_(basis), new_values_(new_values) {}

  /// Says all listed settings, a line each.
  void dump();
  /// Takes the text behind the `$`: a number, `=`, a value.
  bool set(const char* text);
  /// For a sender of Grbl: Grbl's numbers that mean something here, and the settings from 1000
  /// on.
  void dumpForGrbl();
  void sayGrblNumbers();
  bool setForGrbl(const char* text);

 private:
  enum : uint16_t { kFirstForGrbl = 1000 };

  /// `$n=value` behind the `$`; false, with a refusal, if it is none.
  bool read(const char* text, float& number, float& value);
  void dumpFrom(uint16_t first);
  bool setValue(uint8_t number, float value, uint16_t first);
  bool refuseChainSpeed();

  Basis& base_;
  NewValues& new_values_;
};

}  // namespace machine
