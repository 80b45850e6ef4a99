// The lines that the machine sends five times a second at all times.
#pragma once

#include "sled_place.h"

namespace machine {

class Reports {
 public:
  explicit Reports(Parts& parts) : parts_(parts) {}

  /// True every 200 ms.
  bool areDue();
  /// `<Idle,MPos:...>`; the state is a word that the clients know.
  void sayStatus(FlashText state, const Place& place);
  /// `[PE:...]`: how far the chains are from their set-points, and the room for lines.
  void sayErrors();

  /// Three coordinates [mm], in the units of reports to a Grbl sender.
  void sayPlace(const Place& place);

 private:
  Parts& parts_;
  uint32_t last_ms_ = 0;
};

}  // namespace machine
