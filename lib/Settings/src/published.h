// The published firmware's data in the EEPROM: recognised, read whole or not at all, then retired.
#pragma once

#include "bytes.h"
#include "position.h"
#include "values.h"

namespace settings {

/// Whose data is at the addresses of the published firmware.
enum class Foreign : uint8_t {
  kNone,
  kVersion5,      ///< firmware 1.24 to 1.29, with or without Z limits
  kPositionOnly,  ///< of that firmware, its settings erased
  kOther,         ///< another version: 1 to 4 (firmware 1.00 to 1.23), 6 (holey, beta, optical) ...
  kBeforeOne,     ///< positions of firmware before 1.00
};

/// Answer of recognise().
struct Recognised {
  Foreign foreign;
  uint8_t version;    ///< as the data says; 0 if it does not
  bool has_z_limits;  ///< the later layout of version 5
  bool has_position;  ///< counts that may be used; only with kVersion5 and kPositionOnly
};

/// Whose data it is, by its version and markers.
Recognised recognise(const Bytes& bytes);

/// The value of a published setting (0..13, 15..44) in a version 5 block, as it stands there.
float publishedValue(const Bytes& bytes, uint8_t number);

/// Takes over all settings of a version 5 block, or none. Returns kNoIndex, or the number of the
/// first setting that cannot be right.
uint8_t importSettings(const Bytes& bytes, const Recognised& found, Values& values);

/// The position in the published firmware's data: counts, without place and scale.
Position importPosition(const Bytes& bytes);

/// The next byte to overwrite with kErased so that no published firmware takes its data for valid,
/// or kNothingLeft. The order makes it safe to lose power at any byte.
uint16_t nextToRetire(const Bytes& bytes);

const uint16_t kNothingLeft = 0xFFFF;
const uint8_t kErased = 0xFF;

}  // namespace settings
