// From a duty with a sign to the levels of each motor driver's pins. Without Arduino, so that tests
// on the host cover the rows of every shield.
#pragma once

#include <stdint.h>

#include "board_pins.h"

namespace board {

/// The motors, in the order of the machine's axes.
enum class Motor : uint8_t { kLeft, kRight, kZ };

const uint8_t kLow = 0, kHigh = 255;

/// Levels of a driver's three pins: kLow, kHigh, or a PWM duty between them.
struct Levels {
  uint8_t input1, input2, enable;
};

/// A motor's driver; its inputs are in the order forward, reverse.
struct Channel {
  Driver driver;
  uint8_t input1, input2, enable;  ///< pins; on the TLE9201: direction, disable and PWM
  bool forward_is_high;            ///< level of the TLE9201's direction pin for forward
};

/// Whether a pin can carry a PWM: pins of timers 2, 3 and 4 can. Timers 0 and 1 keep the time.
inline bool canPulse(uint8_t pin) { return pin == 2 || pin == 3 || (pin >= 5 && pin <= 10); }

/// A shield's pins for one motor.
inline const MotorPins& pinsOf(const Shield& shield, Motor motor) {
  if (motor == Motor::kLeft) return shield.left;
  return motor == Motor::kRight ? shield.right : shield.z;
}

/// Whether a motor's wires count as crossed. Left and right change when the chains leave below the
/// sprockets. The left motor faces the other way: it is crossed when they leave over the top.
inline bool isCrossed(Motor motor, bool over_top) {
  if (motor == Motor::kLeft) return over_top;
  return motor == Motor::kRight && !over_top;
}

/// A motor's driver, for chains that leave over the top of their sprockets or below.
inline Channel channelOf(const Shield& shield, Motor motor, bool over_top) {
  const MotorPins& pins = pinsOf(shield, motor);
  const bool is_z = motor == Motor::kZ;
  // The TLE9201 has a direction pin, so its pins never change places.
  const bool cross = shield.driver != Driver::kTle9201 && isCrossed(motor, over_top);
  return {shield.driver, cross ? pins.second : pins.first, cross ? pins.first : pins.second,
          pins.enable, !is_z && over_top};
}

namespace drivers_detail {

/// Levels for a bridge with two inputs, of which at least one can carry a PWM. If the pin that
/// should pulse cannot, the other pin pulses inverted against a high level. The motor then brakes
/// between pulses.
inline Levels bridgeLevels(const Channel& channel, bool forward, uint8_t duty, uint8_t enable) {
  if (forward) {
    if (canPulse(channel.input2)) return {kHigh, uint8_t(255 - duty), enable};
    return {duty, kLow, enable};
  }
  if (canPulse(channel.input1)) return {uint8_t(255 - duty), kHigh, enable};
  return {kLow, duty, enable};
}

}  // namespace drivers_detail

/// Levels for a duty of -255 to 255; positive is forward, which winds chain in.
inline Levels levelsFor(const Channel& channel, int16_t drive) {
  const bool forward = drive >= 0;
  const int16_t size = forward ? drive : int16_t(-drive);
  const uint8_t duty = size > 255 ? 255 : uint8_t(size);
  switch (channel.driver) {
    case Driver::kL298:
      if (!canPulse(channel.enable))
        return drivers_detail::bridgeLevels(channel, forward, duty, kHigh);
      return {forward ? kHigh : kLow, forward ? kLow : kHigh, duty};
    case Driver::kTle5206:
      if (duty == 0) return {kLow, kLow, kLow};
      return drivers_detail::bridgeLevels(channel, forward, duty, kLow);
    case Driver::kTb6643:
      if (duty == 0) return {kHigh, kHigh, kLow};
      return {forward ? duty : kLow, forward ? kLow : duty, kLow};
    case Driver::kTle9201:
      break;
  }
  return {forward == channel.forward_is_high ? kHigh : kLow, kLow, duty};
}

/// Levels that take the power off the motor.
inline Levels levelsOff(const Channel& channel) {
  switch (channel.driver) {
    case Driver::kL298:
      return {kHigh, kLow, kLow};
    case Driver::kTle9201:
      return {kLow, kHigh, kLow};
    default:
      return {kLow, kLow, kLow};
  }
}

/// Levels that take the power off the motor and short its winding.
inline Levels levelsToBrake(const Channel& channel) {
  switch (channel.driver) {
    case Driver::kL298:
      return {kLow, kLow, kHigh};
    case Driver::kTb6643:
      return {kHigh, kHigh, kLow};
    default:
      // Both outputs of a TLE5206 are low; a TLE9201 that is not disabled joins its outputs.
      return {kLow, kLow, kLow};
  }
}

/// Whether the driver's third pin is an input; on the TLE5206 it is an output.
inline bool hasEnable(const Channel& channel) {
  return channel.enable != kNoPin && channel.driver != Driver::kTle5206;
}

/// The pin that a motor's driver pulls low on an error: too hot, too much current, too little
/// voltage. kNoPin if the driver reports none.
inline uint8_t errorPinOf(const Shield& shield, Motor motor) {
  return shield.driver == Driver::kTle5206 ? pinsOf(shield, motor).enable : kNoPin;
}

/// The PWM frequency nearest to the wanted frequency that a driver can follow: 1 is 31.4 kHz, 2 is
/// 3.9 kHz, 3 is 490 Hz. Anything else counts as 3.
inline uint8_t pwmFor(Driver driver, uint8_t wanted) {
  if (wanted < 1 || wanted > 3 || driver == Driver::kTle5206) return 3;  // its limit is 1 kHz
  if (driver == Driver::kTle9201 && wanted == 1) return 2;               // its limit is 20 kHz
  return wanted;
}

/// Divider bits of the PWM timer 2 for a choice of 1 to 3; those of timers 3 and 4 are the choice.
inline uint8_t dividerBitsOfTimer2(uint8_t choice) { return choice == 3 ? 4 : choice; }

/// The driver's name in the greeting, as the published firmware spells it.
inline const char* nameOf(Driver driver) {
  switch (driver) {
    case Driver::kTle5206:
      return " TLE5206 ";
    case Driver::kTle9201:
      return " TLE9201 ";
    case Driver::kTb6643:
      return " TB6643 ";
    default:
      return "";
  }
}

}  // namespace board
