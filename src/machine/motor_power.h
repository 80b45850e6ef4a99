// When motors get power, and when they lose it at rest.
#pragma once

#include "sled_place.h"

namespace machine {

/// Gives the motors power, but never before the EEPROM says that the machine moves. Lets them go
/// after a rest of $9, where the friction of usual motors holds the sled: high on the sheet the
/// chains are so flat that it does not. Watches them then, as the motors may be worn or the sled
/// heavier than $62. A sled that slides is held again where it was.
class MotorPower {
 public:
  explicit MotorPower(Parts& parts) : parts_(parts) {}

  /// Returns once all motors hold their set-points; false after a stop.
  bool wake();
  /// To be called often. `is_busy`: something moves or holds on purpose.
  void restWhenIdle(bool is_busy);
  /// From now on they stay on at rest, until the next move or a stop; or no longer.
  void stayOn(bool yes) { rest_ = yes ? Rest::kStayOn : Rest::kUnwatched; }
  /// Waits at most a second for the position's record.
  bool awaitRecord();

  // Reasons to refuse a motion before its motors get power.
  /// Refuses to go on if the sled moved while its motors were off.
  bool goOnFromHere();
  /// Refuse to move chains, or z, by motors whose position loop has no gain: they would lag without
  /// an alarm.
  bool doChainsFollow();
  bool doesZFollow();

 private:
  /// Behaviour of the motors at rest.
  enum class Rest : uint8_t {
    kUnwatched,  ///< on, or switched off by a command, a stop or an alarm
    kLetGo,      ///< off and watched
    kStayOn,     ///< on until the next move or stop: the sled slid, or the bit is in the work
  };

  void holdAgain();
  bool doesFrictionHold() const;
  void sayThatTheyStayOn();

  Parts& parts_;
  Rest rest_ = Rest::kUnwatched;
  bool has_said_so_ = false;  ///< that motors stay on because the sled is high
  uint32_t last_busy_ms_ = 0;
};

}  // namespace machine
