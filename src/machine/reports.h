// The lines that the machine sends five times a second, whatever it does.
#pragma once

#include "sled_place.h"

namespace machine {

class Reports {
 public:
  Reports(Clock& clock, const gcode::Modal& modal, const Axes& axes, const gcode::Input& input,
          Printer& out)
      : clock_(clock), modal_(modal), axes_(axes), input_(input), out_(out) {}

  /// True every 200 ms.
  bool areDue();
  /// `<Idle,MPos:...>`; the state is a word that the clients know.
  void sayStatus(FlashText state, const Place& place);
  /// `[PE:...]`: how far the chains are from their set-points, and the room for lines.
  void sayErrors();

 private:
  Clock& clock_;
  const gcode::Modal& modal_;
  const Axes& axes_;
  const gcode::Input& input_;
  Printer& out_;
  uint32_t last_ms_ = 0;
};

}  // namespace machine
