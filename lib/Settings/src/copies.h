// All settings in two copies, so that a power cut leaves either the old or the new values.
#pragma once

#include "bytes.h"
#include "checksum.h"
#include "values.h"

namespace settings {

/// The result of loading.
enum class Loaded : uint8_t {
  kNothing,  ///< no valid copy
  kAll,      ///< the newest valid copy
  kSome      ///< the newest valid copy, but a value beyond today's limits became its default
};

/// Two copies of all values, each with identification, sequence number and checksum.
///
/// A save brings a copy up to date byte by byte, then the other copy. Meanwhile the copy that is
/// not being written stays valid. Bytes that are already right are not written. A copy counts as
/// written when a pass over it finds all bytes right. Values are stored with their $-numbers, so a
/// new setting moves no other.
class Copies {
 public:
  /// Bytes of a copy of `count` settings.
  static uint16_t bytesFor(uint8_t count) { return uint16_t(kHead + kPair * count + kSum); }

  /// The first copy is at `first_address`, the second `apart` bytes behind it.
  Copies(Bytes& bytes, uint16_t first_address, uint16_t apart);

  /// Reads the newest valid copy into `values`; changes nothing if there is none. A copy that is
  /// invalid or older is written again.
  Loaded load(Values& values);

  /// To be called when values have changed: both copies are written again.
  void save();

  /// True while there is something to write.
  bool isBusy() const { return to_write_ != 0; }

  /// True once a valid copy holds the values as they are.
  bool isStored() const { return stored_; }

  /// True if a copy does not keep what is written into it.
  bool isWorn() const { return worn_; }

  /// Writes at most one byte. To be called again and again while the memory is ready.
  void step(const Values& values);

 private:
  enum : uint8_t { kHead = 6, kPair = 5, kSum = 4, kBytesLookedAt = 8, kMostPasses = 4 };

  uint16_t addressOf(uint8_t copy) const { return uint16_t(first_ + copy * apart_); }
  bool isValid(uint8_t copy) const;
  uint16_t sequenceOf(uint8_t copy) const;
  Loaded read(uint8_t copy, Values& values) const;
  uint8_t byteAt(const Values& values, uint16_t place) const;
  void beginPass();
  void endPass();

  Bytes& bytes_;
  uint16_t first_, apart_;
  uint16_t sequence_ = 0;  ///< of the newest valid copy, or of the copy being written
  uint16_t done_ = 0;      ///< bytes of the copy being written that are right
  Checksum sum_;           ///< of those bytes
  uint8_t target_ = 0;     ///< which copy is written next
  uint8_t to_write_ = 0;   ///< copies that are not up to date
  uint8_t passes_ = 0;     ///< so far, over the copy being written
  bool changed_ = false;   ///< this pass has written something
  bool stored_ = false, worn_ = false;
};

}  // namespace settings
