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
/// written stays valid. Bytes that are right are left alone, and a copy counts as written when a
/// pass over it finds all of them right. Values are stored with their $-numbers, so a new setting
/// moves no other.
class Copies {
 public:
  /// Bytes that a copy of that many settings takes.
  static uint16_t bytesFor(uint8_t count) { return uint16_t(kHead + kPair * count + kSum); }

  /// Two copies from `first_address` on, `apart` bytes from one to the other.
  Copies(Bytes& bytes, uint16_t first_address, uint16_t apart);

  /// Reads the newest valid copy into `values`; leaves them alone if there is none. A copy that is
  /// invalid or older is written anew.
  Loaded load(Values& values);

  /// The values have changed: both copies are to be written (again).
  void save();

  /// True while something is to be written.
  bool isBusy() const { return to_write_ != 0; }

  /// True once a valid copy holds the values as they are.
  bool isStored() const { return stored_; }

  /// True if a copy does not keep what is written into it.
  bool isWorn() const { return worn_; }

  /// Goes on writing the values, by one byte at most. To be called while the bytes are ready.
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
  uint16_t sequence_;  ///< of the newest valid copy, or of the one being written
  uint16_t done_;      ///< bytes of the copy being written that are right
  Checksum sum_;       ///< of those
  uint8_t target_;     ///< which copy is written next
  uint8_t to_write_;   ///< copies that are not up to date
  uint8_t passes_;     ///< over the copy being written, so far
  bool changed_;       ///< this pass has written something
  bool stored_, worn_;
};

}  // namespace settings
