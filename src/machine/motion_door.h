// What every motion is refused for, whichever line asks for it.
#pragma once

#include "answers.h"
#include "sled_place.h"

namespace machine {

/// The door that a motion goes through before its motors get power. A function that refuses has
/// answered the line.
class MotionDoor {
 public:
  MotionDoor(const settings::Values& values, const Axes& axes, const SledPlace& place,
             Answers& answers)
      : values_(values), axes_(axes), place_(place), answers_(answers) {}

  /// Refuses to go on from where nobody sent the sled: it moved while its motors were off.
  bool goesOnFromHere();
  /// Refuse to move chains, or z, by motors whose position loop has no gain: they would lag without
  /// an alarm.
  bool doChainsFollow();
  bool doesZFollow();

 private:
  const settings::Values& values_;
  const Axes& axes_;
  const SledPlace& place_;
  Answers& answers_;
};

}  // namespace machine
