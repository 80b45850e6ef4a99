// All settings in two copies, so that a power cut leaves the old values or the new ones.
#pragma once

#include "bytes.h"
#include "checksum.h"
#include "values.h"

namespace settings {

/// What loading found.
enum class Loaded : uint8_t {
  kNothing,  ///< no valid copy
  kAll,      ///< the newest valid copy
  kSome      ///< the same, but a value was out of today's limits and keeps its default
};

/// Two copies of all values, each with identification, number of its writing and checksum.
///
/// A save brings first one copy up to date, then the other, byte by byte; the one that is not being
/// written stays valid. Values are stored with their $-numbers, so a new setting moves no other.
class Copies {
 public:
  /// Bytes that a copy of that many settings takes.
  static uint16_t bytesFor(uint8_t count) { return uint16_t(6 + 5 * count + 4); }

  /// Two copies from `first_address` on, `apart` bytes from one to the other.
  Copies(Bytes& bytes, uint16_t first_address, uint16_t apart);

  /// Reads the newest valid copy into `values`; leaves them alone if there is none.
  Loaded load(Values& values);

  /// The values have changed: both copies are to be written (again).
  void save();

  /// True while something is to be written.
  bool isBusy() const { return to_write_ != 0; }

  /// True once a valid copy holds the values as they are.
  bool isStored() const { return to_write_ < 2; }

  /// Writes at most one byte; false if there was nothing to do. To be called while ready.
  bool step(const Values& values);

 private:
  Bytes& bytes_;
  uint16_t first_, apart_;
  uint16_t sequence_;  ///< of the copy written last
  uint16_t done_;      ///< bytes of the copy being written that are right
  Checksum sum_;       ///< of those
  uint8_t target_;     ///< which copy is written next
  uint8_t to_write_;   ///< copies that are not up to date
};

}  // namespace settings
