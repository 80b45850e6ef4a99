// Where the machine last came to rest, and whether it has moved since.
#pragma once

#include "bytes.h"

namespace settings {

/// A position as it is stored.
struct Position {
  int32_t left, right, z;  ///< [encoder counts]
  float x, y;              ///< [mm] the sled's place for these counts, by the settings of that time
  uint16_t scale;          ///< fingerprint of the settings that turn counts into lengths
  bool has_place;          ///< false: x and y are not known (counts of the published firmware)
};

/// State of the position when power comes back.
enum class Known : uint8_t {
  kNothing,  ///< never stored, or forgotten on request: chains must be set
  kAtRest,   ///< the machine stood there when power went
  kMoving,   ///< power went in motion (or other firmware ran): the place is where the machine last
             ///< stood
  kDoubted,  ///< the place is where the machine believed to be; doubted() says why it is wrong
};

/// Why a position is doubted: the byte that marks its record. These numbers never change their
/// meaning.
enum class Doubt : uint8_t {
  kMoving = 0x81,     ///< power went in motion
  kScale = 0x82,      ///< $12, $13, $19 or $20 had changed
  kPlace = 0x83,      ///< the chains put the sled elsewhere
  kSimulated = 0x84,  ///< simulated motion changed lengths
  kStack = 0x85,      ///< the firmware's data were overwritten
  kCounts = 0xA5,     ///< the encoders' counts were proved wrong
};

/// Whether stored counts and stored place still agree.
enum class Agreement : uint8_t {
  kAgrees,
  kScaleChanged,  ///< $12, $13, $19 or $20 changed: the counts now mean other lengths
  kPlaceDiffers,  ///< today's settings put the sled elsewhere
};

/// [mm] Two places this far apart are not the same. With unchanged settings they differ by less
/// than 0.02 mm.
const float kSamePlace = 0.5f;

/// Compares a stored position with today's scale, and with the place (x, y) [mm] that forward
/// kinematics gives for its counts today.
Agreement compare(const Position& kept, uint16_t scale, float x, float y);

/// Records in a ring of slots, so that no cell is written often.
///
/// A new record is written to another slot than the newest record, and counts once its checksum is
/// whole. A byte of the newest record, outside the checksum, says that the machine has begun to
/// move. In a round of the ring that byte is written twice, any other byte at most once.
class PositionSlots {
 public:
  enum : uint8_t { kBytesPerSlot = 30 };

  PositionSlots(Bytes& bytes, uint16_t first_address, uint8_t slots);

  /// Finds the newest record; reads all slots.
  Known load(Position& position);

  /// Stores a position at rest. A record that is still being written is given up for it.
  void keep(const Position& position);

  /// Stores that nothing is known.
  void forget();

  /// Marks that the machine moves away from the newest record. A record that is still being written
  /// is given up.
  void beginMoving();

  /// Marks the newest record as wrong. Of several reasons the first counts; beginMoving() keeps
  /// that mark, endDoubt() and keep() end it.
  void doubt(Doubt why);

  /// The doubt is settled: the lengths have been declared, but are not yet stored.
  void endDoubt() { want(kMoved); }

  /// Why the position of a record that says kDoubted is wrong.
  Doubt doubted() const { return Doubt(mark_); }

  /// True while something is to be written.
  bool isBusy() const { return writing_ || (moving_ && mark_ != wanted_); }

  /// True once the mark that beginMoving() asked for is written.
  bool mayMove() const { return moving_ && !isBusy(); }

  /// Writes at most one byte. To be called again and again while the memory is ready.
  void step();

 private:
  enum : uint8_t { kMoved = 0, kRests = 0x5A };

  uint16_t addressOf(uint8_t slot) const { return uint16_t(first_ + slot * kBytesPerSlot); }
  uint8_t after(uint8_t slot) const { return slot + 1 < slots_ ? uint8_t(slot + 1) : uint8_t(0); }
  bool isValid(uint8_t slot) const;
  void readNewest();
  void begin(const uint8_t* record, uint8_t mark);
  void want(uint8_t mark);
  void writeRecord();
  void writeMark();

  Bytes& bytes_;
  uint16_t first_;
  uint8_t slots_;
  uint8_t newest_;             ///< slot of the newest record
  uint8_t mark_ = kMoved;      ///< of the newest record
  uint16_t sequence_ = 0;      ///< of the newest record
  bool exists_ = false;        ///< there is a newest record
  uint8_t wanted_ = kMoved;    ///< what the mark should say while moving_: kMoved or a Doubt
  bool moving_ = false;        ///< the mark should say `wanted_`
  bool tried_ = false;         ///< the mark has been written, and is not there yet
  bool writing_ = false;       ///< a record is being written
  bool maybe_whole_ = false;   ///< its checksum has been begun, so it could already count
  bool holds_newest_ = false;  ///< `record_` is the newest record, not a record that was given up
  uint8_t target_ = 0;         ///< slot being written
  uint8_t failed_ = 0;         ///< how many slots before `target_` did not keep the record
  uint8_t done_ = 0;           ///< bytes of the record being written that are right
  uint8_t record_[kBytesPerSlot] = {};
};

}  // namespace settings
