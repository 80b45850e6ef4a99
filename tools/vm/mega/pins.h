// The Mega's pins on two motor shields, with chains over the top of their sprockets.
#pragma once

#include <cstdint>

#include "mega/virtual_board.h"

namespace vm {

const int kMotors = 3;  // left, right, z

/// Bridge inputs in the order for "wind in", and a third pin.
struct DriverPins {
  int input1, input2;
  int third;      ///< the PWM, or the driver's error flag
  bool has_flag;  ///< the third pin is the driver's error flag, low on an error; the inputs pulse

  /// The duty that the pins show, -255 to 255; positive winds in.
  int duty(const VirtualBoard& board) const {
    const int level1 = board.pin(input1), level2 = board.pin(input2);
    if (has_flag) return level1 - level2;
    if ((level1 != 0) == (level2 != 0)) return 0;
    const int level = board.pin(third);
    return level1 != 0 ? level : -level;
  }
  /// Whether the pins short the motor's winding.
  bool shorts(const VirtualBoard& board) const {
    const int level1 = board.pin(input1), level2 = board.pin(input2);
    return level1 == level2 && (has_flag || board.pin(third) == 255);
  }
  /// Shows whether the driver reports an error, if it can.
  void complain(VirtualBoard& board, bool complains) const {
    if (has_flag) board.setPin(third, !complains);
  }
};

/// Connections of a shield.
struct ShieldPins {
  int straps;  ///< as VirtualBoard::strap() takes them
  DriverPins drivers[kMotors];
  int spindle, laser, probe;
};

/// v1.2 with L298 bridges, as most machines have it.
const ShieldPins kShield2 = {
    63, {{12, 11, 10, false}, {4, 6, 5, false}, {7, 9, 8, false}}, 17, 16, 14};
/// v1.3 with TLE5206 bridges, which report heat and too much current.
const ShieldPins kShield3 = {
    52, {{11, 10, 12, true}, {6, 4, 5, true}, {7, 9, 8, true}}, 40, 41, 43};

/// An encoder on two inputs of the Mega.
class EncoderPins {
 public:
  EncoderPins(int first, int second) : first_(first), second_(second) {}

  /// Sets the count with which the board starts. Both channels are high there, as the Mega's inputs
  /// are while nothing pulls them, so a program that reads them sees no edge.
  void restart(VirtualBoard& board, uint16_t count) {
    count_ = start_ = count;
    show(board);
  }

  /// Edges that are still missing to reach a count, which wraps round.
  int missing(uint16_t count) const { return int16_t(count - count_); }

  /// Makes the next `pairs` of edges come at once, so that their direction is unknown.
  void miss(int pairs) { to_miss_ += pairs; }

  /// Makes an edge, or a pair, towards a count, if any is missing.
  void step(VirtualBoard& board, uint16_t count) {
    const int left = missing(count), at_once = to_miss_ > 0 ? 2 : 1;
    if (left < at_once && left > -at_once) return;
    if (to_miss_ > 0) --to_miss_;
    count_ = uint16_t(count_ + (left > 0 ? at_once : -at_once));
    show(board);
  }

 private:
  void show(VirtualBoard& board) const {
    // second, first: 11, 01, 00, 10
    const int phase = uint16_t(count_ - start_) % 4;
    board.setPin(second_, phase == 0 || phase == 3);
    board.setPin(first_, phase == 0 || phase == 1);
  }

  int first_, second_;
  uint16_t count_ = 0, start_ = 0;
  int to_miss_ = 0;
};

/// The encoders of all motors, on both shields.
struct Encoders {
  EncoderPins of[kMotors] = {{3, 2}, {20, 21}, {18, 19}};
};

const int kLoose = 255;

/// [degrees] of the servo by timer 5's pulses; kLoose where it makes none.
inline int servoOf(VirtualBoard& board) {
  const uint16_t kTimsk5 = 0x73, kOcr5b = 0x12a;
  const uint8_t* const data = board.avr()->data;
  const int pulse = data[kOcr5b] | data[kOcr5b + 1] << 8;  // [half a microsecond]
  return data[kTimsk5] == 0 ? kLoose : (pulse - 1088) * 180 / 3712;
}

}  // namespace vm
