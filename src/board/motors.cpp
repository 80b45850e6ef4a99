// Puts the levels from drivers.h on the pins, and counts the encoders' edges.
#include "motors.h"

#include <Arduino.h>
#include <util/atomic.h>

using machine::Axis;
using machine::kAxisCount;

namespace board {
namespace {

static_assert(uint8_t(Motor::kLeft) == machine::kLeftAxis && uint8_t(Motor::kZ) == machine::kZAxis,
              "motors and axes are numbered alike");

Quadrature encoders[kEncoderPairs];

void putLevel(uint8_t pin, uint8_t level) {
  // A level without PWM goes straight to the pin: analogWrite could start a timer on it.
  if (level == kLow || level == kHigh)
    digitalWrite(pin, level);
  else
    analogWrite(pin, level);
}

uint8_t bitsOfPair0() { return PIND & 3; }
uint8_t bitsOfPair1() { return (PIND >> 2) & 3; }
uint8_t bitsOfPair2() { return (PINE >> 4) & 3; }

}  // namespace

ISR(INT0_vect) { encoders[0].turn(bitsOfPair0()); }
ISR(INT1_vect, ISR_ALIASOF(INT0_vect));
ISR(INT2_vect) { encoders[1].turn(bitsOfPair1()); }
ISR(INT3_vect, ISR_ALIASOF(INT2_vect));
ISR(INT4_vect) { encoders[2].turn(bitsOfPair2()); }
ISR(INT5_vect, ISR_ALIASOF(INT4_vect));

void Motors::begin(const Shield* shield) {
  shield_ = shield;
  if (!shield) return;
  arrange(true, 3);
  for (uint8_t i = 0; i < kAxisCount; ++i) {
    const Channel& channel = channel_[i];
    // First the levels, then the directions, so that no pin is driven the wrong way even for a
    // moment.
    putLevel(channel.input1, levelsOff(channel).input1);
    putLevel(channel.input2, levelsOff(channel).input2);
    pinMode(channel.input1, OUTPUT);
    pinMode(channel.input2, OUTPUT);
    if (hasEnable(channel)) {
      putLevel(channel.enable, levelsOff(channel).enable);
      pinMode(channel.enable, OUTPUT);
    }
    const MotorPins& pins = pinsOf(*shield, Motor(i));
    pinMode(pins.encoder_a, INPUT_PULLUP);
    pinMode(pins.encoder_b, INPUT_PULLUP);
  }
  encoders[0].state = bitsOfPair0();
  encoders[1].state = bitsOfPair1();
  encoders[2].state = bitsOfPair2();
  EICRA = 0x55;  // INT0 to INT3 on either edge
  EICRB = 0x05;  // INT4 and INT5, too
  EIFR = 0x3f;
  EIMSK = 0x3f;
}

void Motors::put(Axis axis, const Levels& levels) {
  const Channel& channel = channel_[axis];
  Levels& shown = shown_[axis];
  // Less power comes before a new direction, more power after it: else the motor is driven the old
  // way for a moment.
  const bool has_enable = hasEnable(channel);
  if (has_enable && levels.enable < shown.enable) putLevel(channel.enable, levels.enable);
  if (levels.input1 != shown.input1) putLevel(channel.input1, levels.input1);
  if (levels.input2 != shown.input2) putLevel(channel.input2, levels.input2);
  if (has_enable && levels.enable > shown.enable) putLevel(channel.enable, levels.enable);
  shown = levels;
}

void Motors::drive(Axis axis, int16_t duty) {
  if (shield_) put(axis, levelsFor(channel_[axis], duty));
}

void Motors::release(Axis axis) {
  if (shield_) put(axis, levelsOff(channel_[axis]));
}

void Motors::brake(Axis axis) {
  if (shield_) put(axis, levelsToBrake(channel_[axis]));
}

void Motors::releaseAll() {
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
    for (uint8_t i = 0; i < kAxisCount; ++i) release(Axis(i));
  }
}

uint16_t Motors::count(Axis axis) {
  const EncoderWiring& wiring = encoder_[axis];
  uint16_t count;
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) { count = encoders[wiring.pair].count; }
  return wiring.reversed ? uint16_t(-count) : count;
}

uint16_t Motors::illegalSteps(Axis axis) {
  uint16_t illegal;
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) { illegal = encoders[encoder_[axis].pair].illegal; }
  return illegal;
}

void Motors::arrange(bool over_top, uint8_t pwm_choice) {
  if (!shield_) return;
  for (uint8_t i = 0; i < kAxisCount; ++i) {
    channel_[i] = channelOf(*shield_, Motor(i), over_top);
    encoder_[i] = encoderOf(*shield_, Motor(i), over_top);
    const Levels off = levelsOff(channel_[i]);
    // The inverse differs from every level, so the next levels are always put on the pins.
    shown_[i] = {uint8_t(~off.input1), uint8_t(~off.input2), uint8_t(~off.enable)};
    put(Axis(i), off);
  }
  const uint8_t choice = pwmFor(shield_->driver, pwm_choice);
  TCCR2B = uint8_t((TCCR2B & ~7) | dividerBitsOfTimer2(choice));
  TCCR3B = uint8_t((TCCR3B & ~7) | choice);
  TCCR4B = uint8_t((TCCR4B & ~7) | choice);
}

}  // namespace board
