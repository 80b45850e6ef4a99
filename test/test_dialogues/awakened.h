// What a machine says and knows when power comes back, for a given EEPROM.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

/// What a machine knows right after power-on.
struct Belief {
  bool is_known;          ///< it reports a position and no alarm
  double left, right, z;  ///< [mm] to be used only if `is_known`
  std::string said;       ///< the whole greeting
};

/// Lets a machine start with that EEPROM and asks it.
Belief awaken(const std::vector<uint8_t>& eeprom);
