// Lines with a `$` that show or set a value.
#pragma once

#include "answers.h"
#include "new_values.h"
#include "waiting.h"

namespace machine {

/// `$$` and `$n=value`.
class SettingsLines {
 public:
  SettingsLines(settings::Memory& memory, const settings::Values& values, NewValues& new_values,
                Printer& out, Answers& answers, Waiting& waiting)
      : memory_(memory),
        values_(values),
        new_values_(new_values),
        out_(out),
        answers_(answers),
        waiting_(waiting) {}

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

  settings::Memory& memory_;
  const settings::Values& values_;
  NewValues& new_values_;
  Printer& out_;
  Answers& answers_;
  Waiting& waiting_;
};

}  // namespace machine
