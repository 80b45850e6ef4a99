// setup() and loop(): wiring of the machine, no decisions.

#include <Arduino.h>

namespace {

const uint32_t kBaud = 57600;  // the speed that GroundControl and WebControl open the port with

}  // namespace

void setup() {
  Serial.begin(kBaud);
  Serial.println(F("Plumb, firmware for the Maslow CNC"));
}

void loop() {}
