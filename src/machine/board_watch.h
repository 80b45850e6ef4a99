// Watches what carries the machine: the processor's supply, the motor drivers' complaints, the
// EEPROM's wear.
#pragma once

#include "ports.h"

namespace machine {

/// What the board has come to.
enum class BoardEvent : uint8_t {
  kNone,
  kSupplyLow,    ///< below what the settings allow; once, until it was 0.1 V above
  kDriverFails,  ///< a powered driver has complained for a fifth of a second
  kWorn,         ///< the EEPROM does not keep what is written; once
};

/// What is asked of it.
struct BoardLimits {
  float band_gap;      ///< [V] of this processor's reference
  float least_supply;  ///< [V]; 0: whatever it is
};

/// Looks every 20 ms; reads nothing that makes it wait.
class BoardWatch {
 public:
  enum : uint8_t { kInterval = 20 };  // [ms]

  /// One look, with the motors on or off.
  BoardEvent look(Aux& aux, const BoardLimits& limits, bool is_powered, bool is_worn);

  /// [V] 0 until it is known.
  float supply() const { return supply_; }
  /// [V] Lowest since this was last asked.
  float lowestSupply();
  /// Whose driver complained last.
  Axis failing() const { return failing_; }

 private:
  enum : uint8_t { kSettling = 8, kPatience = 10 };  // [looks]

  void takeSupply(uint16_t reading, float band_gap);
  bool hasFallen(float least);
  bool hasComplained(Aux& aux);

  float supply_ = 0, lowest_ = 0;  ///< [V]
  uint8_t settling_ = kSettling;   ///< readings after the start that are not believed
  uint8_t complaints_ = 0;         ///< looks in a row
  Axis failing_ = kLeftAxis;
  bool is_low_ = false, is_wear_told_ = false;
};

}  // namespace machine
