// A gear motor on the pins of a simulated Mega, behind an L298 as on shield v1.2: the pins drive
// it, and its encoder drives the encoder's pins.
#pragma once

#include <cmath>

#include "mega/virtual_board.h"

namespace vm {

/// The pins of a motor.
struct MotorPins {
  int input1, input2, enable;  ///< bridge inputs in the order for forward, and the PWM
  int first, second;           ///< encoder channels; the count rises when the second leads
};

/// A motor; a positive drive lowers the count.
class VirtualMotor {
 public:
  VirtualMotor(VirtualBoard& board, const MotorPins& pins, double counts_per_second)
      : board_(board), pins_(pins), top_(counts_per_second) {
    // Both channels high: if they were low at the start, the level interrupt would never end.
    step(0);
  }

  /// Lets `seconds` pass, in which at most a single edge may come.
  void advance(double seconds) {
    const double kTimeConstant = 0.03;  // [s]
    const double drive = driveNow();
    const double target = std::fabs(drive) > 0.05 ? -drive * top_ : 0;
    speed_ += (target - speed_) * (1 - std::exp(-seconds / kTimeConstant));
    place_ += speed_ * seconds;
    if (place_ >= count_ + 1) step(+1);
    if (place_ <= count_ - 1) step(-1);
  }

  long count() const { return count_; }

  /// The drive by the pins, -1 to 1.
  double driveNow() const {
    const double duty = board_.pin(pins_.enable).level / 255.0;
    const bool input1 = board_.pin(pins_.input1).level != 0,
               input2 = board_.pin(pins_.input2).level != 0;
    if (input1 == input2) return 0;
    return input1 ? duty : -duty;
  }

 private:
  void step(int by) {
    count_ += by;
    // second, first: 11, 01, 00, 10
    const int phase = int(((count_ % 4) + 4) % 4);
    board_.setPin(pins_.second, phase == 0 || phase == 3);
    board_.setPin(pins_.first, phase == 0 || phase == 1);
  }

  VirtualBoard& board_;
  MotorPins pins_;
  double top_, speed_ = 0, place_ = 0.5;
  long count_ = 0;
};

}  // namespace vm
