// What the published firmware left in the EEPROM: recognised, read whole or not at all, retired.
#pragma once

#include "bytes.h"
#include "position.h"
#include "values.h"

namespace settings {

/// Whose data lies where the published firmware keeps its own.
enum class Foreign : uint8_t {
  kNone,
  kVersion5,      ///< firmware 1.24 to 1.29, both layouts
  kPositionOnly,  ///< the same, its settings erased
  kOther,         ///< another version: 1 to 4 (firmware 1.00 to 1.23), 6 (holey, beta, optical) ...
  kBeforeOne,     ///< positions of firmware before 1.00
};

struct Recognised {
  Foreign foreign;
  uint8_t version;  ///< as the data says; 0 if it does not
  bool has_limits;  ///< version 5 with Z limits
  bool has_position;
};

Recognised recognise(const Bytes& bytes);

/// The raw value of a published setting in a version 5 block; 0..13 and 15..44.
float publishedValue(const Bytes& bytes, uint8_t number);

/// Takes all settings over, or none: the number of the first that cannot be right, else kNoIndex.
uint8_t importSettings(const Bytes& bytes, const Recognised& found, Values& values);

/// The counts it kept.
Position importPosition(const Bytes& bytes);

/// The next byte to overwrite so that no published firmware finds its data again, or kNothingLeft.
uint16_t nextToRetire(const Bytes& bytes);
const uint16_t kNothingLeft = 0xFFFF;
const uint8_t kErased = 0xFF;

}  // namespace settings
