// Other pins of the shield: spindle (relay or servo), laser, probe.
#pragma once

#include "board_pins.h"
#include "machine/ports.h"

namespace board {

/// The auxiliary pins; all off without a shield.
class AuxPins : public machine::Aux {
 public:
  void begin(const Shield* shield);
  void set(machine::Output output, bool high) override;
  void pulse(machine::Output output, uint8_t level) override;
  void turnServo(uint8_t degrees) override;
  bool probeTouches() override;
  bool driverFails(machine::Axis axis) override;
  uint16_t bandGap() override;

 private:
  const Shield* shield_;
};

}  // namespace board
