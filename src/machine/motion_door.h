// What every motion is refused for, whichever line asks for it.
#pragma once

#include "sled_place.h"

namespace machine {

/// The door that a motion goes through before its motors get power. A function that refuses has
/// answered the line.
class MotionDoor {
 public:
  MotionDoor(Basis& basis, const SledPlace& place) : base_(basis), place_(place) {}

  /// Refuses to go on from where nobody sent the sled: it moved while its motors were off.
  bool goesOnFromHere();
  /// Refuse to move chains, or z, by motors whose position loop has no gain: they would lag without
  /// an alarm.
  bool doChainsFollow();
  bool doesZFollow();

 private:
  Basis& base_;
  const SledPlace& place_;
};

}  // namespace machine
