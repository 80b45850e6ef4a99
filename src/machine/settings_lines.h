// Lines with a `$` that show or set a value.
#pragma once

#include "coordinates.h"
#include "greeting.h"
#include "new_values.h"
#include "spindle.h"

namespace machine {

/// `$$` and `$n=value`.
class SettingsLines {
 public:
  explicit SettingsLines(Parts& parts) : parts_(parts) {}

  /// Runs a line that begins with `$` from a Maslow client.
  bool run(const char* line);
  /// `$RST=` and a letter.
  bool reset(const char* what);
  /// Prints all listed settings, one a line, with numbers from `first` on.
  void dump(uint16_t first = 0);
  /// Takes the text behind the `$`: a number, `=`, a value.
  bool set(const char* text);
  /// For a Grbl sender: Grbl's numbers that mean something here, and the settings from 1000 on.
  void dumpForGrbl();
  void sayGrblNumbers();
  bool setForGrbl(const char* text);

 private:
  enum : uint16_t { kFirstForGrbl = 1000 };

  /// `$n=value` behind the `$`; false, with a refusal, if it is none.
  void restoreDefaults(settings::Reset what);
  bool read(const char* text, float& number, float& value);
  bool setValue(uint8_t number, float value, uint16_t first);
  bool refuseChainSpeed();

  Parts& parts_;
};

}  // namespace machine
