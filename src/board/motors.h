// The three motors of the shield that is plugged in, and their encoders.
#pragma once

#include "board_pins.h"
#include "drivers.h"
#include "machine/ports.h"
#include "quadrature.h"

namespace board {

/// Motor drivers by PWM and direction pins, encoders by interrupts on all six lines.
class Motors : public machine::Drives {
 public:
  /// Takes the pins of a shield, motors off; without a shield (null) nothing is ever driven.
  void begin(const Shield* shield);
  void drive(machine::Axis axis, int16_t duty) override;
  void release(machine::Axis axis) override;
  void brake(machine::Axis axis) override;
  uint16_t count(machine::Axis axis) override;
  uint16_t illegalSteps(machine::Axis axis) override;
  void arrange(bool over_top, uint8_t pwm_choice) override;
  /// Takes the power off all motors. Interrupts may call it too.
  void releaseAll();

 private:
  void put(machine::Axis axis, const Levels& levels);

  const Shield* shield_;
  Channel channel_[machine::kAxisCount];
  EncoderWiring encoder_[machine::kAxisCount];
  Levels shown_[machine::kAxisCount];
};

}  // namespace board
