// Pulls a chain tight with a limited force: the chain's speed says how hard it is pulled.
#pragma once

#include "waiting.h"

namespace machine {

/// The pulls of B11.
///
/// At a constant duty a motor slows down by a turn a minute for every 38 N of chain: torque against
/// back-EMF, whatever its friction, its bridge and its supply may be. So the chain is first paid
/// out a little, then wound in slack at the duty that gives a few turns a minute. Where it has lost
/// 1.2 turns a minute, the motor is switched off; until it stands the chain pulls with about 80 N,
/// and the gears hold it. A sled at the top of the sheet pulls with 145 N.
///
/// The duty that B11 states bounds winding in. It does not bound paying out, which must end within
/// a moment: a motor that pays out pulls on nothing. A motor that is wired in reverse winds in
/// there; it is switched off after a millimetre (kWrongWay), and is not well (kDead).
///
/// 38 N: motor constant k = 3.7 Nm/A at the sprocket, winding and supply R = 4.1 ohm, viscous
/// friction b = 0.4 Nm s/rad, so (k^2 / R + b) / radius. R and k of a motor are known to 30 % and
/// 10 %, so the force to 30 %: 60 to 105 N. Even if the program were late, the motor would stall at
/// 250 N.
class ChainPull {
 public:
  enum class Result : uint8_t {
    kStopped,  ///< a stop was asked for
    kTaut,     ///< the chain was tight
    kSlack,    ///< the time was over before it was tight
    kDead,     ///< the motor hardly turned or lost its power, or its encoder did not count
  };

  ChainPull(Axes& axes, Waiting& waiting, Axis axis, int16_t most_duty)
      : axes_(axes), waiting_(waiting), axis_(axis), most_duty_(most_duty) {}

  /// Pulls three times, or as often as the time allows.
  Result run(uint32_t ms);

  uint8_t pulls() const { return pulls_; }
  float length() const { return sum_ / float(pulls_); }  ///< [mm] mean of all pulls
  float spread() const { return longest_ - shortest_; }  ///< [mm]
  float force() const;                                   ///< [N] of the last pull

 private:
  Result payOut(float mm, int16_t duty);
  Result pullAgain();
  Result findFreeSpeed();
  Result windInFast();
  Result rest();
  Result windIn(bool from_slack);
  bool pass(int16_t duty);
  void note(float length);
  bool isOver(uint32_t margin_ms) {
    return waiting_.milliseconds() - start_ms_ + margin_ms >= most_ms_;
  }

  Axes& axes_;
  Waiting& waiting_;
  const Axis axis_;
  const int16_t most_duty_;
  int16_t duty_ = 0;
  uint32_t start_ms_ = 0, most_ms_ = 0;
  float speed_ = 0, free_ = 0;  ///< [rpm] of winding in: now, and of the slack chain
  float sum_ = 0, shortest_ = 0, longest_ = 0;
  uint8_t pulls_ = 0;
};

}  // namespace machine
