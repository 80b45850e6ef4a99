// A gear motor on the pins of a simulated Mega, behind an L298 as on shield v1.2: it turns as the
// pins tell it and its encoder answers on the encoder's pins.
#pragma once

#include <cmath>

#include "mega/virtual_board.h"

namespace vm {

/// Which pins a motor is on.
struct MotorPins {
  int one, two, enable;  ///< bridge inputs in the order that means forward, and the PWM
  int first, second;     ///< encoder channels; the count rises when the second leads
};

/// One motor; positive drive lowers the count.
class VirtualMotor {
 public:
  VirtualMotor(VirtualBoard& board, const MotorPins& pins, double counts_per_second)
      : board_(board), pins_(pins), top_(counts_per_second) {
    // Both channels high: low before the program listens would be an interrupt without end.
    step(0);
  }

  /// Lets `seconds` pass, in which at most one edge may fall.
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

  /// -1 to 1, as the pins say.
  double driveNow() const {
    const double duty = board_.pin(pins_.enable).level / 255.0;
    const bool one = board_.pin(pins_.one).level != 0, two = board_.pin(pins_.two).level != 0;
    if (one == two) return 0;
    return one ? duty : -duty;
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
