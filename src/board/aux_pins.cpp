// Spindle, laser and probe by their pins; the servo's pulses by timer 5, fifty a second.
#include "aux_pins.h"

#include <Arduino.h>

#include "drivers.h"

namespace board {
namespace {

// Timer 5 at 2 MHz: pulses of 544 to 2400 us for 0 to 180 degrees, as Arduino's servo library.
const uint16_t kServoPeriod = 40000;
const uint16_t kServoShortest = 1088;
const uint16_t kServoSpan = 3712;

uint8_t servo_pin;

const uint8_t kBandGapChannel = 0x1e;
const uint8_t kConvert = 1 << ADEN | 1 << ADSC | 7;  // at 125 kHz

}  // namespace

ISR(TIMER5_COMPA_vect) { digitalWrite(servo_pin, HIGH); }
ISR(TIMER5_COMPB_vect) { digitalWrite(servo_pin, LOW); }

void AuxPins::begin(const Shield* shield) {
  shield_ = shield;
  // The converter measures nothing but the reference against the supply, so it never has to settle.
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

void AuxPins::set(machine::Output output, bool high) {
  if (!shield_) return;
  const uint8_t pin = output == machine::Output::kLaser ? shield_->laser : shield_->spindle;
  digitalWrite(pin, high);
  pinMode(pin, OUTPUT);
}

void AuxPins::turnServo(uint8_t degrees) {
  if (!shield_) return;
  servo_pin = shield_->spindle;
  if (degrees == machine::kNoServo) {
    TIMSK5 = 0;
    digitalWrite(servo_pin, LOW);
    return;
  }
  pinMode(servo_pin, OUTPUT);
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
