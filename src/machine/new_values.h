// After a new value of a setting: works out again whatever it touches.
#pragma once

#include "sled_place.h"

namespace machine {

/// Hands new settings to the parts of the machine. All functions are for a machine at rest.
class NewValues {
 public:
  enum : uint8_t { kAll = 255 };  ///< everything is touched

  explicit NewValues(Parts& parts) : parts_(parts) {}

  /// At the start: takes over all settings, without working out the place.
  void takeAll();
  /// Takes over what new values touch; `touches` are bits of settings::Touch. Clients send many
  /// values in a row, so the geometry waits for refreshBeforeLine().
  void take(uint8_t touches);
  /// Takes over the geometry if it is out of date, and works out the place. To be called before
  /// each line that moves or asks for the place.
  void refreshBeforeLine();
  /// Refreshes the geometry once no new value has come for a while, and says the place. To be
  /// called often.
  void refreshWhenQuiet(bool is_moving);
  /// Takes over the geometry without working out the place.
  void prepareGeometry();
  /// Says in a line which corrections two settings carry, if any of them is new.
  void sayCarriedTwice();

 private:
  void refreshGeometry(Search why);
  void arrangeDrives();

  Parts& parts_;
  uint32_t geometry_changed_ms_ = 0;
  uint8_t said_twice_ = 0;  ///< a bit for each correction that was said and is still carried twice
  bool is_geometry_stale_ = false;
};

}  // namespace machine
