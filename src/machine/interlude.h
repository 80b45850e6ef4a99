// An interlude: a time in which the program waits and the operator may work.
#pragma once

#include <GCode.h>

namespace machine {

/// A pause (M0, M1, M6, z by hand) or a hold, from its beginning until z is back where it was.
///
/// Lines that came before it belong to the program and wait. A sender that has not noticed it may
/// send a few more. So lines count as the operator's only if none came in its first moments.
class Interlude {
 public:
  /// Begins a pause: the program waits at this line.
  void pause(const gcode::Modal& modal, uint32_t now_ms, bool is_input_empty) {
    begin(modal, now_ms, is_input_empty);
    is_paused_ = true;
  }

  /// Begins a hold: the axes stop on their path.
  void hold(const gcode::Modal& modal, uint32_t now_ms, bool is_input_empty) {
    begin(modal, now_ms, is_input_empty);
    is_ending_ = is_lowering_ = false;
    is_held_ = true;
  }

  /// `~`: ends it as soon as z is back.
  void resume() { is_ending_ = isOn(); }

  void end() { is_paused_ = is_held_ = is_ending_ = is_lowering_ = false; }

  bool isOn() const { return is_paused_ || is_held_; }
  bool isPaused() const { return is_paused_; }
  bool isEnding() const { return is_ending_; }

  /// Modes of the program, to be restored at the end.
  const gcode::Modal& modal() const { return modal_; }

  /// Whether lines that come in are the operator's. To be called often from the beginning on.
  bool takesLines(uint32_t now_ms, bool is_input_empty) {
    if (!isOn() || is_ending_ || is_serving_) return false;
    if (is_young_ && now_ms - since_ms_ < kFirstMs) {
      if (!is_input_empty) is_programs_ = true;
      return false;
    }
    is_young_ = false;
    return !is_programs_;
  }

  /// Says whether a line of the operator is in execution.
  void serve(bool yes) { is_serving_ = yes; }
  bool isServing() const { return is_serving_; }

  /// True once: when z begins to go back.
  bool beginsLowering() {
    const bool begins = !is_lowering_;
    is_lowering_ = true;
    return begins;
  }

 private:
  enum : uint16_t { kFirstMs = 300 };

  void begin(const gcode::Modal& modal, uint32_t now_ms, bool is_input_empty) {
    if (isOn()) return;
    modal_ = modal;
    since_ms_ = now_ms;
    is_young_ = true;
    is_programs_ = !is_input_empty;
    is_ending_ = is_lowering_ = false;
  }

  gcode::Modal modal_;
  uint32_t since_ms_ = 0;
  bool is_paused_ = false, is_held_ = false, is_ending_ = false, is_lowering_ = false;
  bool is_serving_ = false;
  bool is_young_ = false;     ///< the interlude has just begun
  bool is_programs_ = false;  ///< lines of the program wait
};

}  // namespace machine
