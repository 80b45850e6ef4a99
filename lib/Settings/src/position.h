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
  kMoving,   ///< power went in motion: this is where that motion began
};

/// Records in a ring of slots, so that no cell is written often.
///
/// A record is written beside the newest one and counts once its checksum is whole. One byte of the
/// newest record, outside the checksum, says that the machine has begun to move. Per round of the
/// ring that byte is written twice, any other at most once.
class PositionSlots {
 public:
  enum : uint8_t { kBytesPerSlot = 30 };

  PositionSlots(Bytes& bytes, uint16_t first_address, uint8_t slots);

  /// Finds the newest record; reads all slots.
  Known load(Position& position);

  /// Keeps a position at rest; replaces one that is still being written.
  void keep(const Position& position);

  /// Keeps that nothing is known.
  void forget();

  /// Marks the newest record as left behind; gives up one that is still being written.
  void beginMoving();

  /// Takes the mark back while nothing has moved: something else made the position doubtful.
  bool isMarkedMoving() const { return mark_ == kMoved; }

  /// True while something is to be written.
  bool isBusy() const { return writing_ || mark_wanted_ != mark_; }

  /// True once the mark of beginMoving is stored.
  bool mayMove() const { return !writing_ && mark_wanted_ == kMoved && mark_ == kMoved; }

  /// Writes at most one byte; false if there was nothing to write. To be called while ready.
  bool step();

 private:
  enum : uint8_t { kMoved = 0, kRests = 0x5A };

  Bytes& bytes_;
  uint16_t first_;
  uint8_t slots_;
  uint8_t newest_;  ///< slot of the newest record
  uint8_t mark_, mark_wanted_;
  uint16_t sequence_;
  bool writing_;
  uint8_t done_;                   ///< bytes of the record that are written
  uint8_t record_[kBytesPerSlot];  ///< what is being written
};

}  // namespace settings
