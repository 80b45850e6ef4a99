// The front end for Grbl senders.
#pragma once

#include "b_lines.h"
#include "stops.h"

namespace machine {

/// Answers `?` and `$` lines and runs jogs for a Grbl sender.
class GrblFront {
 public:
  GrblFront(Parts& parts, Stops& stops) : parts_(parts), stops_(stops) {}

  /// A `?` came.
  void askStatus(bool is_in_line);
  /// Sends the status if it was asked for.
  void answerStatus(bool is_executing);
  /// Whether a line shows that a Grbl sender is connected: `$I`, `$G`, `$X`.
  bool isGreetedBy(const char* line);
  bool isOfMaslow(const char* line) const;
  void speakMaslow();
  /// Runs a line that begins with `$`.
  __attribute__((noinline)) bool run(const char* line);
  /// 0x18.
  void reset();
  /// 0x85, or a hold in a jog.
  void endJog();
  /// Whether a line is a jog that waited when jogging ended: it is answered, but not run.
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

  Parts& parts_;
  Stops& stops_;
  bool is_status_due_ = false;  ///< a `?` came
  bool is_new_ = false;         ///< it has asked for the first time
  bool is_sure_ = false;        ///< it has asked again, or sent a `$` line
  uint8_t dropped_jogs_ = 0;    ///< lines that waited when a jog was ended
};

}  // namespace machine
