// A simulated board around the firmware's machine, and what must hold for any input.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "brain/simulated_eeprom.h"
#include "machine/machine.h"
#include "settings_flash.h"
#include "simulated_motor.h"

/// Thrown out of the main program wherever it waits.
struct PowerCut {};
struct TheEnd {};

/// What happens to the machine.
struct Story {
  std::vector<uint8_t> eeprom;  ///< at power-on; empty: never written
  /// The characters to send; characters 1 to 7 are not sent but act on the board (see world.cpp).
  std::string sent;
  int step_ms = 5;        ///< between two looks at the wire
  bool is_polite = true;  ///< waits for the answer to a line before it sends the next
};

/// Plays an input, then presses Stop and asks for the settings. Aborts if anything that must hold
/// does not. Returns the EEPROM's bytes at the end.
std::vector<uint8_t> live(const Story& story);

/// An EEPROM of this firmware that knows where the sled is.
const std::vector<uint8_t>& ownImage();
