// The board's faults over its whole life: how often each happened, and which was last.
#pragma once

#include "bytes.h"

namespace settings {

/// Kinds of events, in the order of the stored counts.
enum class Event : uint8_t {
  kBrownOut,     ///< the board started because the processor's supply had broken down
  kWatchdog,     ///< the board started because the firmware had hung
  kSupplyLow,    ///< the processor's supply was below its limit
  kDriverFails,  ///< a motor's driver reported an error
  kCount
};

/// Counts of events, in two records by turns: the record that is not being written stays valid.
///
/// A count stops at kMost, so a cell is written at most 20,000 times. A cell bears 100,000 writes.
class EventLog {
 public:
  enum : uint16_t { kMost = 9999 };
  enum : uint8_t { kBytes = 15 };

  /// The first record is at `first_address`, the second `apart` bytes behind it.
  EventLog(Bytes& bytes, uint16_t first_address, uint16_t apart)
      : bytes_(bytes), first_(first_address), apart_(apart) {}

  /// Reads the newest valid record, or begins with counts of zero.
  void load();

  /// Counts an event at once; step() stores the count.
  void note(Event event);

  uint16_t count(Event event) const { return record_.count[uint8_t(event)]; }
  /// How many events there were in all, which is also the number of the last one.
  uint16_t total() const { return record_.total; }
  /// The last event; meaningful if total() is not 0.
  Event last() const { return Event(record_.last); }

  bool isBusy() const { return is_writing_; }
  /// Writes at most one byte. To be called again and again while the memory is ready.
  void step();

 private:
  /// The first kBytes of this structure are stored as they are, low bytes first.
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
  uint8_t newest_ = 1;  ///< which record is the newest; the next is written to the other
  uint8_t done_ = 0;    ///< bytes of the record being written that are right
  bool is_writing_ = false;
  bool was_tried_ = false;  ///< the next byte has been written and is not right yet
};

}  // namespace settings
