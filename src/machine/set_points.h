// Set-points on their way from the main program, which works them out, to the control tick.
#pragma once

#include <Motion.h>
#include <stdint.h>

namespace machine {

/// Where all axes shall be at one tick.
struct SetPoint {
  int32_t left, right, z;  ///< [counts of motion::kCountsPerMm]
};

/// A ring with one writer, the main program, and one reader, the control tick.
///
/// Long enough that the main program may be busy for 110 ms; short enough for a stop to act soon.
class SetPoints {
 public:
  enum : uint8_t { kMost = 11 };

  bool hasRoom() const { return next(head_) != tail_; }
  bool isEmpty() const { return head_ == tail_; }

  /// To be called by the writer, if there is room.
  void push(const SetPoint& point) {
    ring_[head_] = point;
    fence();
    head_ = next(head_);
  }

  /// To be called by the reader, if it is not empty.
  SetPoint pop() {
    const SetPoint point = ring_[tail_];
    fence();
    tail_ = next(tail_);
    return point;
  }

  /// To be called while the other side is held.
  void clear() { tail_ = head_; }

 private:
  /// The compiler must not move the point behind the index that hands it over.
  static void fence() { __asm__ volatile("" ::: "memory"); }

  static uint8_t next(uint8_t at) { return at == kMost ? 0 : uint8_t(at + 1); }

  SetPoint ring_[kMost + 1];
  volatile uint8_t head_ = 0, tail_ = 0;
};

}  // namespace machine
