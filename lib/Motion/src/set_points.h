// Set-points on their way from the main program, which works them out, to the control tick.
#pragma once

#include <stdint.h>

namespace motion {

/// Where all axes shall be at a tick.
struct SetPoint {
  int32_t left, right, z;  ///< [counts of kCountsPerMm]
};

/// Copies number by number: for a whole struct the board runs a loop that takes twice the cycles.
inline void copy(const SetPoint& from, SetPoint& to) {
  to.left = from.left;
  to.right = from.right;
  to.z = from.z;
}

/// The way to a set-point from the set-point before it, in a tick.
struct Leg {
  SetPoint to;
  uint32_t way;   ///< [counts] length over all axes, at least 1 and less than 2^17
  uint16_t gain;  ///< [counts/tick] by which the way may change from tick to tick, at least 1
  uint8_t beam;   ///< strength of a laser on this leg; 0: off
};

inline void copy(const Leg& from, Leg& to) {
  copy(from.to, to.to);
  to.way = from.way;
  to.gain = from.gain;
  to.beam = from.beam;
}

/// A ring with one writer, the main program, and one reader, the control tick.
///
/// The main program may be busy for eleven ticks, 110 ms at 100 Hz. If it is busy for longer, the
/// ring runs dry: the axes stay at the last set-point, and the mover starts again from rest.
class SetPoints {
 public:
  enum : uint8_t { kMost = 11 };

  bool hasRoom() const { return next(head_) != tail_; }
  bool isEmpty() const { return head_ == tail_; }
  /// How many legs wait.
  uint8_t count() const {
    const uint8_t head = head_, tail = tail_;
    return head >= tail ? uint8_t(head - tail) : uint8_t(head + kMost + 1 - tail);
  }

  /// For the writer, only if there is room: the leg that push() adds.
  Leg& vacant() { return ring_[head_]; }
  void push() {
    fence();
    head_ = next(head_);
  }

  /// For the reader: takes the next leg, or false if there is none.
  bool take(Leg& leg) {
    if (isEmpty()) {
      ran_dry_ = true;
      return false;
    }
    copy(ring_[tail_], leg);
    fence();
    tail_ = next(tail_);
    return true;
  }

  /// For the reader after take(): the two ends of the step `ticks` ahead, or of the last step that
  /// is known; false if nothing waits.
  bool stepAhead(uint8_t ticks, const SetPoint*& from, const SetPoint*& to) const {
    const uint8_t tail = tail_, waiting = count();
    if (waiting == 0) return false;
    const uint8_t steps = ticks < waiting ? ticks : waiting;
    // The entry before the tail still holds the leg that was taken: the writer never fills it.
    const uint8_t last = uint8_t(tail + steps - 1);
    const uint8_t at = last > kMost ? uint8_t(last - kMost - 1) : last;
    to = &ring_[at].to;
    from = &ring_[at == 0 ? uint8_t(kMost) : uint8_t(at - 1)].to;
    return true;
  }

  /// For the reader, if a leg waits: the next leg.
  const Leg& first() const { return ring_[tail_]; }

  /// For the writer: whether the reader has met an empty ring since the last call.
  bool hasRunDry() {
    const bool was = ran_dry_;
    ran_dry_ = false;
    return was;
  }

  /// To be called while the other side is kept off.
  void clear() { tail_ = head_; }

 private:
  /// Keeps the compiler from writing a leg after the index that hands it over.
  static void fence() { __asm__ volatile("" ::: "memory"); }

  static uint8_t next(uint8_t at) { return at == kMost ? 0 : uint8_t(at + 1); }

  Leg ring_[kMost + 1] = {};
  volatile uint8_t head_ = 0, tail_ = 0;
  volatile bool ran_dry_ = false;
};

}  // namespace motion
