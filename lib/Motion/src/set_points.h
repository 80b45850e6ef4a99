// Set-points on their way from the main program, which works them out, to the control tick.
#pragma once

#include <stdint.h>

namespace motion {

/// Where all axes shall be at one tick.
struct SetPoint {
  int32_t left, right, z;  ///< [counts of kCountsPerMm]
};

/// The way to a set-point from the one before it, in one tick.
struct Leg {
  SetPoint to;
  uint32_t way;   ///< [counts] over all axes, at least 1 and less than 2^17
  uint16_t gain;  ///< [counts/tick] by which the way may change from tick to tick, at least 1
  uint8_t beam;   ///< how strong a laser is on it; 0: off
};

/// A ring with one writer, the main program, and one reader, the control tick.
///
/// The main program may be busy for eleven ticks, 110 ms at 100 Hz; and a stop acts that soon. If
/// it is busy for longer, the tick finds nothing: set-points stay where they are, and the mover
/// sets out from rest again.
class SetPoints {
 public:
  enum : uint8_t { kMost = 11 };

  bool hasRoom() const { return next(head_) != tail_; }
  bool isEmpty() const { return head_ == tail_; }
  /// How many wait.
  uint8_t count() const {
    const uint8_t head = head_, tail = tail_;
    return head >= tail ? uint8_t(head - tail) : uint8_t(head + kMost + 1 - tail);
  }

  /// To be called by the writer, if there is room.
  void push(const Leg& leg) {
    ring_[head_] = leg;
    fence();
    head_ = next(head_);
  }

  /// To be called by the reader: the next one, or false if there is none.
  bool take(Leg& leg) {
    if (isEmpty()) {
      ran_dry_ = true;
      return false;
    }
    leg = ring_[tail_];
    fence();
    tail_ = next(tail_);
    return true;
  }

  /// To be called by the reader after take(): the last of the next `ticks` steps that are known, as
  /// its two ends; false if nothing waits.
  bool stepAhead(uint8_t ticks, const SetPoint*& from, const SetPoint*& to) const {
    const uint8_t tail = tail_, waiting = count();
    if (waiting == 0) return false;
    const uint8_t steps = ticks < waiting ? ticks : waiting;
    // The place before the tail still holds what was taken: the writer leaves it free.
    const uint8_t last = uint8_t(tail + steps - 1);
    const uint8_t at = last > kMost ? uint8_t(last - kMost - 1) : last;
    to = &ring_[at].to;
    from = &ring_[at == 0 ? uint8_t(kMost) : uint8_t(at - 1)].to;
    return true;
  }

  /// To be called by the reader, if there is one: that which comes next.
  const Leg& first() const { return ring_[tail_]; }

  /// To be called by the writer: whether the reader found nothing since this was last asked.
  bool hasRunDry() {
    const bool was = ran_dry_;
    ran_dry_ = false;
    return was;
  }

  /// To be called while the other side is held.
  void clear() { tail_ = head_; }

 private:
  /// The compiler must not move the point behind the index that hands it over.
  static void fence() { __asm__ volatile("" ::: "memory"); }

  static uint8_t next(uint8_t at) { return at == kMost ? 0 : uint8_t(at + 1); }

  Leg ring_[kMost + 1];
  volatile uint8_t head_ = 0, tail_ = 0;
  volatile bool ran_dry_ = false;
};

}  // namespace motion
