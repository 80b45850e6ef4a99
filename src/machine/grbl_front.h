// The front for senders of Grbl.
#pragma once

#include "b_lines.h"
#include "moves.h"
#include "overrides.h"
#include "reports.h"
#include "settings_lines.h"
#include "single_axis.h"
#include "stops.h"

namespace machine {

/// Answers `?` and lines with a `$`, and does jogs, for a sender of Grbl.
class GrblFront {
 public:
  GrblFront(Basis& basis, LiveOverrides& overrides, Greeting& greeting, Reports& reports,
            SledPlace& place, Spindle& spindle, ZAxis& z, NewValues& new_values,
            Coordinates& coordinates, SettingsLines& settings_lines, Moves& moves,
            SingleAxis& single_axis, Stops& stops)
      : base_(basis),
        overrides_(overrides),
        greeting_(greeting),
        reports_(reports),
        place_(place),
        spindle_(spindle),
        z_(z),
        new_values_(new_values),
        coordinates_(coordinates),
        settings_lines_(settings_lines),
        moves_(moves),
        single_axis_(single_axis),
        stops_(stops) {}

  /// A `?` came.
  void askStatus(bool is_in_line);
  /// Says the status if it was asked for.
  void answerStatus(const Place& place, bool is_executing);
  /// Whether a line of a client of Maslow's takes this one for a sender of Grbl: `$I` and `$G`.
  bool isGreetedBy(const char* line);
  bool isOfMaslow(const char* line) const;
  void speakMaslow();
  /// Does a line that begins with `$`.
  __attribute__((noinline)) bool run(const char* line);
  /// 0x18.
  void reset();
  /// 0x85, or a hold in a jog.
  void endJog();
  /// Whether a line is a jog that waited when a jog was ended: it is answered, and not done.
  bool isDroppedJog(const char* line);

 private:
  FlashText stateNow(bool is_executing);
  void resetModes();
  void showCoordinates();
  void showModes();
  bool unlock();
  bool toggleCheck();
  bool jog(const char* text);
  bool queueJog(const char* text);
  bool readJog(const char* text, gcode::Words& words);

  Basis& base_;
  LiveOverrides& overrides_;
  Greeting& greeting_;
  Reports& reports_;
  SledPlace& place_;
  Spindle& spindle_;
  ZAxis& z_;
  NewValues& new_values_;
  Coordinates& coordinates_;
  SettingsLines& settings_lines_;
  Moves& moves_;
  SingleAxis& single_axis_;
  Stops& stops_;
  bool is_status_due_ = false;  ///< a `?` came
  bool is_new_ = false;         ///< it has asked for the first time
  bool is_sure_ = false;        ///< it has asked again, or in words
  uint8_t dropped_jogs_ = 0;    ///< lines that waited when a jog was ended
};

}  // namespace machine
