// Watches the board: the processor's supply, errors of the motor drivers, wear of the EEPROM.
#pragma once

#include "ports.h"

namespace machine {

/// Faults of a board.
enum class BoardEvent : uint8_t {
  kNone,
  kSupplyLow,    ///< the supply is below its limit; said once, until it was 0.1 V above
  kDriverFails,  ///< a driver with power has reported an error for a tenth of a second
  kWorn,         ///< the EEPROM does not keep what is written; said once
};

/// Limits for the board.
struct BoardLimits {
  float band_gap;      ///< [V] of this processor's reference
  float least_supply;  ///< [V] least supply; 0: no limit
};

/// Looks every 20 ms. No reading makes it wait.
class BoardWatch {
 public:
  enum : uint8_t { kInterval = 20 };  // [ms]

  /// A look at the board, with the motors on or off.
  BoardEvent look(Aux& aux, const BoardLimits& limits, bool is_powered, bool is_worn);

  /// [V] 0 until it is known.
  float supply() const { return supply_; }
  /// [V] Lowest supply since the last call.
  float lowestSupply();
  /// The axis whose driver reported an error last.
  Axis failing() const { return failing_; }

 private:
  enum : uint8_t { kSettling = 8, kPatience = 5 };  // [looks]

  void takeSupply(uint16_t reading, float band_gap);
  bool hasFallen(float least);
  bool hasComplained(Aux& aux);

  float supply_ = 0, lowest_ = 0;  ///< [V]
  uint8_t settling_ = kSettling;   ///< readings after the start that are ignored
  uint8_t complaints_ = 0;         ///< looks in a row with an error
  Axis failing_ = kLeftAxis;
  bool is_low_ = false, is_wear_told_ = false;
};

}  // namespace machine
