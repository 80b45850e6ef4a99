// What went wrong with the board, ever: how often, and what last.
#pragma once

#include "bytes.h"

namespace settings {

/// Kinds of events; their order is that of the stored counts.
enum class Event : uint8_t {
  kBrownOut,     ///< it started because the processor's supply had broken down
  kWatchdog,     ///< it started because the firmware had hung
  kSupplyLow,    ///< the processor's supply was below its limit
  kDriverFails,  ///< a motor's driver reported an error
  kCount
};

/// Counts of events, in two records by turns: the one that is not being written stays valid.
///
/// A count ends at kMost and is then written no more, so a cell is written 20,000 times at most; it
/// bears 100,000.
class EventLog {
 public:
  enum : uint16_t { kMost = 9999 };
  enum : uint8_t { kBytes = 15 };

  /// Two records, the first at `first_address`, `apart` bytes from one to the other.
  EventLog(Bytes& bytes, uint16_t first_address, uint16_t apart)
      : bytes_(bytes), first_(first_address), apart_(apart) {}

  /// Reads the newest valid record, or begins with none.
  void load();

  /// An event has come; it counts at once and is stored by step().
  void note(Event event);

  uint16_t count(Event event) const { return record_.count[uint8_t(event)]; }
  /// How many events came in all, which is the place of the last one in their order; 0: none.
  uint16_t total() const { return record_.total; }
  /// What came last; meaningful if total() is not 0.
  Event last() const { return Event(record_.last); }

  bool isBusy() const { return is_writing_; }
  /// Goes on writing, by one byte at most. To be called while the bytes are ready.
  void step();

 private:
  /// The first kBytes of it are stored as they are, low bytes first.
  struct Record {
    uint32_t sum;
    uint16_t total;
    uint16_t count[uint8_t(Event::kCount)];
    uint8_t last;
  };

  static uint32_t sumOf(const Record& record);
  uint16_t addressOf(uint8_t which) const { return uint16_t(first_ + which * apart_); }

  Bytes& bytes_;
  uint16_t first_, apart_;
  Record record_ = {0, 0, {0, 0, 0, 0}, 0};
  uint8_t newest_ = 1;  ///< the next one is written to the other
  uint8_t done_ = 0;    ///< bytes of the record being written that are right
  bool is_writing_ = false;
  bool was_tried_ = false;  ///< the next byte has been written and is not right yet
};

}  // namespace settings
