// Spindle, laser and probe by their pins. Timer 5 makes the servo's pulses, 50 a second, or those
// of spindle and laser, 488 a second. It switches the pins by interrupts, because no shield has
// these outputs on a pin that a timer could pulse.
#include "aux_pins.h"

#include <Arduino.h>
#include <util/atomic.h>

#include "drivers.h"

namespace board {
namespace {

// Timer 5 at 2 MHz: pulses of 544 to 2400 us for 0 to 180 degrees, like Arduino's servo library.
const uint16_t kServoPeriod = 40000;
const uint16_t kServoShortest = 1088;
const uint16_t kServoSpan = 3712;

uint8_t servo_pin;
bool servo_turns;

// Timer 5 at 250 kHz, two counts for each of 256 steps: 2.05 ms.
const uint16_t kPulsePeriod = 512;

/// An output that timer 5 pulses.
struct Pulsed {
  volatile uint8_t* port;
  uint8_t bit;
  uint8_t level;  // 1 to 254; at 0 the pin keeps its level
};
Pulsed pulsed[2];  // by machine::Output

void raise(const Pulsed& output) {
  if (output.level != 0) *output.port |= output.bit;
}

void lower(const Pulsed& output) {
  if (output.level != 0) *output.port &= uint8_t(~output.bit);
}

/// Starts timer 5 if an output needs it, and stops it if none does.
void arrangePulses() {
  if (servo_turns) return;
  TIMSK5 = 0;
  if (pulsed[0].level == 0 && pulsed[1].level == 0) return;
  TCCR5A = 0;
  TCCR5B = 1 << WGM52 | 1 << CS51 | 1 << CS50;
  OCR5A = kPulsePeriod - 1;
  OCR5B = uint16_t(2 * pulsed[0].level);
  OCR5C = uint16_t(2 * pulsed[1].level);
  if (TCNT5 >= kPulsePeriod) TCNT5 = 0;
  TIMSK5 = uint8_t(1 << OCIE5A | (pulsed[0].level ? 1 << OCIE5B : 0) |
                   (pulsed[1].level ? 1 << OCIE5C : 0));
}

const uint8_t kBandGapChannel = 0x1e;
const uint8_t kConvert = 1 << ADEN | 1 << ADSC | 7;  // at 125 kHz

}  // namespace

ISR(TIMER5_COMPA_vect) {
  if (servo_turns) {
    digitalWrite(servo_pin, HIGH);
    return;
  }
  raise(pulsed[0]);
  raise(pulsed[1]);
}

ISR(TIMER5_COMPB_vect) {
  if (servo_turns)
    digitalWrite(servo_pin, LOW);
  else
    lower(pulsed[0]);
}

ISR(TIMER5_COMPC_vect) { lower(pulsed[1]); }

void AuxPins::begin(const Shield* shield) {
  shield_ = shield;
  // The converter only ever measures the reference against the supply, so it needs no time to
  // settle.
  ADMUX = 1 << REFS0 | kBandGapChannel;
  ADCSRA = kConvert;
  if (!shield) return;
  for (uint8_t i = 0; i < machine::kAxisCount; ++i) {
    const uint8_t pin = errorPinOf(*shield, Motor(i));
    if (pin != kNoPin) pinMode(pin, INPUT_PULLUP);
  }
  digitalWrite(shield->laser, LOW);
  pinMode(shield->laser, OUTPUT);
  pinMode(shield->probe, INPUT_PULLUP);
}

void AuxPins::set(machine::Output output, bool high) { pulse(output, high ? 255 : 0); }

void AuxPins::pulse(machine::Output output, uint8_t level) {
  if (!shield_) return;
  const uint8_t pin = output == machine::Output::kLaser ? shield_->laser : shield_->spindle;
  const bool stands = level == 0 || level == 255;
  // The control tick, commands and timer 5 all use these.
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
    pulsed[uint8_t(output)] = {portOutputRegister(digitalPinToPort(pin)), digitalPinToBitMask(pin),
                               stands ? uint8_t(0) : level};
    arrangePulses();
    if (stands) digitalWrite(pin, level);
    pinMode(pin, OUTPUT);
  }
}

void AuxPins::turnServo(uint8_t degrees) {
  if (!shield_) return;
  servo_pin = shield_->spindle;
  if (degrees == machine::kNoServo) {
    TIMSK5 = 0;
    servo_turns = false;
    digitalWrite(servo_pin, LOW);
    arrangePulses();
    return;
  }
  pinMode(servo_pin, OUTPUT);
  servo_turns = true;
  TCCR5A = 0;
  TCCR5B = 1 << WGM52 | 1 << CS51;
  OCR5A = kServoPeriod;
  OCR5B = uint16_t(kServoShortest + uint32_t(kServoSpan) * degrees / 180);
  TIMSK5 = 1 << OCIE5A | 1 << OCIE5B;
}

bool AuxPins::driverFails(machine::Axis axis) {
  if (!shield_) return false;
  const uint8_t pin = errorPinOf(*shield_, Motor(axis));
  return pin != kNoPin && digitalRead(pin) == LOW;
}

uint16_t AuxPins::bandGap() {
  if (ADCSRA & 1 << ADSC) return 0;
  const uint16_t reading = ADC;
  ADCSRA = kConvert;
  return reading;
}

bool AuxPins::probeTouches() { return shield_ && digitalRead(shield_->probe) == LOW; }

}  // namespace board
