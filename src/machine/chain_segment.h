// A piece of a path on which both chains' lengths follow a quadratic between exact knots, asked at
// any place along it.
#pragma once

#include <Motion.h>

namespace machine {

/// Both chains as quadratics of the way along the path.
class ChainSegment {
 public:
  void forget() { length_ = 0; }

  /// Whether the place `along` [mm] of the path is within.
  bool holds(float along) const { return length_ > 0 && along <= begin_ + length_; }

  /// Through three knots, `middle` half way; `length` [mm] from `begin` on.
  void draw(float begin, float length, const motion::Knot& from, const motion::Knot& middle,
            const motion::Knot& to) {
    begin_ = begin;
    length_ = length;
    from_ = from;
    to_ = to;
    const float left = float(to.left - from.left), right = float(to.right - from.right);
    left_bend_ = 2 * left - 4 * float(middle.left - from.left);
    right_bend_ = 2 * right - 4 * float(middle.right - from.right);
    left_rise_ = left - left_bend_;
    right_rise_ = right - right_bend_;
  }

  float end() const { return begin_ + length_; }
  const motion::Knot& lastKnot() const { return to_; }

  motion::Knot at(float along) const {
    const float share = (along - begin_) / length_;
    return {from_.left + int32_t(lround(share * (left_rise_ + share * left_bend_))),
            from_.right + int32_t(lround(share * (right_rise_ + share * right_bend_)))};
  }

 private:
  float begin_ = 0, length_ = 0;
  motion::Knot from_, to_;
  float left_rise_, left_bend_, right_rise_, right_bend_;
};

}  // namespace machine
