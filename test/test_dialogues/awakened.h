// What a machine says and believes when power comes back, given its EEPROM.
#pragma once

#include <string>
#include <vector>

/// A machine's belief right after power-on.
struct Belief {
  bool is_known;          ///< it says a position, and no alarm
  double left, right, z;  ///< [mm] to be used only if `is_known`
  std::string said;       ///< all of its greeting
};

/// Lets a machine start with that EEPROM and asks it.
Belief awaken(const std::vector<uint8_t>& eeprom);
