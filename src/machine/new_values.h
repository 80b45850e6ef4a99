// What follows a new value of a setting: whatever it touches is worked out again.
#pragma once

#include "cutter.h"
#include "printer.h"
#include "sled_place.h"

namespace machine {

/// Settings as the parts of the machine have taken them over. All of it at rest.
class NewValues {
 public:
  enum : uint8_t { kAll = 255 };  ///< everything is touched

  NewValues(const settings::Values& values, Geometry& geometry, Axes& axes, Planner& mover,
            Drives& drives, Cutter& cutter, SledPlace& place, Clock& clock, Printer& out)
      : values_(values),
        geometry_(geometry),
        axes_(axes),
        planner_(mover),
        drives_(drives),
        cutter_(cutter),
        place_(place),
        clock_(clock),
        out_(out) {}

  /// At the start: takes over all of them; the place is not looked for.
  void takeAll();
  /// Takes over what new values touch, bits of settings::Touch. The clients send many in a row: the
  /// geometry waits for refreshGeometry().
  void take(uint8_t touches);
  /// Takes over the geometry if it is out of date, and looks for the place; before each move.
  void refreshGeometry();
  /// The same once no new value has come for a while, and says the place; to be called often.
  void refreshWhenQuiet(bool is_moving);
  /// Takes over the geometry without a look for the place.
  void prepareGeometry();
  /// Says in one line which corrections two settings carry, if some are new among them.
  void sayCarriedTwice();

 private:
  void arrangeDrives();

  const settings::Values& values_;
  Geometry& geometry_;
  Axes& axes_;
  Planner& planner_;
  Drives& drives_;
  Cutter& cutter_;
  SledPlace& place_;
  Clock& clock_;
  Printer& out_;
  uint32_t geometry_changed_ms_ = 0;
  uint8_t said_twice_ = 0;  ///< a bit for each correction that was said and is carried twice still
  bool is_geometry_stale_ = false;
};

}  // namespace machine
