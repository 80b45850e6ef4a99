// Where the machine stood when it last came to rest, and whether it has moved since.
#pragma once

#include "bytes.h"

namespace settings {

/// What is kept of a position.
struct Position {
  int32_t left, right, z;  ///< [encoder counts]
  float x, y;              ///< [mm] where that put the sled, by the settings of the time
  uint16_t scale;          ///< fingerprint of the settings that turn counts into lengths
  bool has_place;          ///< false: x and y are not known (counts of the published firmware)
};

/// What is known of the position after power came back.
enum class Known : uint8_t {
  kNothing,  ///< never saved, or forgotten on request: chains must be set
  kAtRest,   ///< the machine stood there when power went
  kMoving,   ///< power went in motion (or other firmware ran): where the machine was before
  kDoubted,  ///< the counts were proved wrong: where the machine believed to be before
};

/// Whether kept counts and kept place still say the same.
enum class Agreement : uint8_t {
  kAgrees,
  kScaleChanged,  ///< $12, $13, $19 or $20 are others: the counts mean other lengths now
  kPlaceDiffers,  ///< today's settings put the sled elsewhere
};

/// From here on [mm] two places are not the same; settings in force put it within 0.02 mm.
const float kSamePlace = 0.5f;

/// Compares a kept position with today's scale and with the place (x, y) [mm] that forward
/// kinematics finds for its counts today.
Agreement compare(const Position& kept, uint16_t scale, float x, float y);

/// Records in a ring of slots, so that no cell is written often.
///
/// A record is written beside the newest one and counts once its checksum is whole. One byte of the
/// newest record, outside the checksum, says that the machine has begun to move. In one round of
/// the ring that byte is written twice, any other at most once.
class PositionSlots {
 public:
  enum : uint8_t { kBytesPerSlot = 30 };

  PositionSlots(Bytes& bytes, uint16_t first_address, uint8_t slots);

  /// Finds the newest record; reads all slots.
  Known load(Position& position);

  /// Keeps a position at rest, instead of one that is still being written.
  void keep(const Position& position);

  /// Keeps that nothing is known.
  void forget();

  /// Marks the newest record as left behind, instead of one that is still being written.
  void beginMoving();

  /// Marks the newest record as proved wrong; beginMoving() leaves that mark, keep() ends it.
  void doubt();

  /// True while something is to be written.
  bool isBusy() const { return writing_ || (moving_ && mark_ != wanted_); }

  /// True once beginMoving() has done its work.
  bool mayMove() const { return moving_ && !isBusy(); }

  /// Goes on writing, by one byte at most. To be called while the bytes are ready.
  void step();

 private:
  enum : uint8_t { kMoved = 0, kRests = 0x5A, kWrong = 0xA5 };

  uint16_t addressOf(uint8_t slot) const { return uint16_t(first_ + slot * kBytesPerSlot); }
  uint8_t after(uint8_t slot) const { return slot + 1 < slots_ ? uint8_t(slot + 1) : uint8_t(0); }
  bool isValid(uint8_t slot) const;
  void readNewest();
  void begin(const uint8_t* record, uint8_t mark);
  void writeRecord();
  void writeMark();

  Bytes& bytes_;
  uint16_t first_;
  uint8_t slots_;
  uint8_t newest_;     ///< slot of the newest record
  uint8_t mark_;       ///< of the newest record
  uint16_t sequence_;  ///< of the newest record
  bool exists_;        ///< there is one
  uint8_t wanted_;     ///< what the mark should say while moving_: kMoved or kWrong
  bool moving_;        ///< the mark should say so
  bool tried_;         ///< the mark has been written, and is not there yet
  bool writing_;       ///< a record
  bool maybe_whole_;   ///< its checksum has been begun, so it could already count
  bool holds_newest_;  ///< record_ is the newest record, not one that was given up
  uint8_t target_;     ///< slot being written
  uint8_t failed_;     ///< how many slots before it would not take the record
  uint8_t done_;       ///< bytes of it that are right
  uint8_t record_[kBytesPerSlot];
};

}  // namespace settings
