// A sled on two chains, each with its motor; set-points from the mover and its ring, as on the
// board. Chains run straight from sprocket to bit, because only control is measured here.
#pragma once

#include "axis.h"

/// A sled with two of the forty motors.
template <class Axis = ControlledAxis>
class SledWith {
 public:
  using Point = motion::Point<double>;

  /// `ring`: most set-points that the main program keeps ahead.
  SledWith(unsigned seed, double rate, int ring = motion::SetPoints::kMost)
      : ring_(ring),
        ahead_(motion::AxisLoop::ticksAhead(float(1 / rate))),
        axis_{{seed, rate}, {(seed + 17) % kMotors, rate}} {
    mover_.prepare({100, 10, 1000.0f / 60, 0.66f, 0.05f}, float(1 / rate));
    mover_.setSprockets({{float(-kHalf), float(kUp)}, {float(kHalf), float(kUp)}, {0, 0, 0}});
    mover_.standAt(pointOf(start_));
    for (int i = 0; i < int(rate / 2); ++i) tick();
  }

  /// Queues a line at a feed [mm/min]; while the queue is full, ticks go on.
  void lineTo(Point to, double feed) {
    while (!mover_.hasRoom()) tick();
    const motion::Point<float> from = {float(aim_.x), float(aim_.y)},
                               end = {float(to.x), float(to.y)};
    mover_.add(motion::line(from, end), 0, float(feed / 60));
    aim_ = to;
  }

  /// Goes on to the end of all moves, and for a second more.
  void finish() {
    while (!mover_.isIdle() || !worked_out_.isEmpty() || !points_.isEmpty()) tick();
    for (int i = 0; i < int(1 / axis_[0].seconds); ++i) tick();
  }

  std::vector<Point> places;  ///< where the bit was after each tick

 private:
  static constexpr double kHalf = 1489.2, kUp = 1072.6;  // [mm] of the sprockets from the middle

  static motion::Lengths<float> exactly(motion::Point<float> at) {
    const double x = double(at.x), up = kUp - double(at.y);
    return {float(std::hypot(x + kHalf, up)), float(std::hypot(kHalf - x, up)), true};
  }

  static motion::SetPoint pointOf(Point at) {
    const motion::Lengths<float> lengths = exactly({float(at.x), float(at.y)});
    return {motion::toCounts(lengths.left), motion::toCounts(lengths.right), 0};
  }

  void tick() {
    fill();
    motion::Leg leg;
    double ahead[2] = {0, 0};
    if (points_.take(leg)) {
      --waiting_;
      now_ = leg.to;
      const motion::SetPoint *from, *to;
      if (points_.stepAhead(ahead_, from, to)) {
        ahead[0] = motion::toMm<double>(to->left - from->left);
        ahead[1] = motion::toMm<double>(to->right - from->right);
      }
    }
    drive(ahead);
  }

  /// Fills the ring, but with at most `ring_` set-points, as if it were short.
  void fill() {
    mover_.fill(worked_out_, exactly);
    for (; waiting_ < ring_ && worked_out_.take(points_.vacant()); ++waiting_) points_.push();
  }

  void drive(const double (&ahead)[2]) {
    const double asked[2] = {motion::toMm<double>(now_.left), motion::toMm<double>(now_.right)};
    for (int i = 0; i < 2; ++i) axis_[i].tick({asked[i] - length0_[i], ahead[i]});
    const double left = length0_[0] + axis_[0].motor.turns() * kTurnLength;
    const double right = length0_[1] + axis_[1].motor.turns() * kTurnLength;
    const double x = (left * left - right * right) / (4 * kHalf);
    places.push_back({x, kUp - std::sqrt(left * left - (x + kHalf) * (x + kHalf))});
  }

  const Point start_ = {0, 0};
  const double length0_[2] = {std::hypot(kHalf, kUp), std::hypot(kHalf, kUp)};
  motion::Mover mover_;
  motion::SetPoints worked_out_, points_;
  motion::SetPoint now_ = pointOf(start_);
  Point aim_ = start_;
  int ring_, waiting_ = 0;
  uint8_t ahead_;
  Axis axis_[2];
};
