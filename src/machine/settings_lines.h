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

 private:
  bool setValue(uint8_t number, float value);
  bool refuseChainSpeed();

  settings::Memory& memory_;
  const settings::Values& values_;
  NewValues& new_values_;
  Printer& out_;
  Answers& answers_;
  Waiting& waiting_;
};

}  // namespace machine
