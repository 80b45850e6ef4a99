// Measures the share of time in which an output of the simulated Mega is high.
#pragma once

#include <cmath>
#include <cstdint>
#include <deque>

#include "virtual_board.h"

namespace vm {

/// Watches a pin from edge to edge, and gives the share of its last whole pulse.
class PulseMeter {
 public:
  /// Watches a pin (Arduino's number) of a board, which must live as long as this object.
  PulseMeter(VirtualBoard& board, int pin) : avr_(board.avr()) {
    board.watchPin(pin, [this](bool high) { note(high); });
  }

  /// The share in 255ths. 0 or 255 for a pin without an edge for two periods of the slowest pulses.
  uint8_t level() {
    const avr_cycle_count_t kStands = 5 * kClock / 1000;
    while (rises_.size() > kPulses + 1) rises_.pop_front();
    if (avr_->cycle - last_edge_ > kStands) rises_.clear();
    if (rises_.size() < 2) return is_high_ ? 255 : 0;
    const Rise &first = rises_.front(), &last = rises_.back();
    const double share = double(last.high_before - first.high_before) / double(last.at - first.at);
    return uint8_t(std::lround(255 * share));
  }

 private:
  enum { kPulses = 4 };

  /// When the pin rose, and for how many cycles it was high before.
  struct Rise {
    avr_cycle_count_t at, high_before;
  };

  void note(bool high) {
    if (high == is_high_) return;
    if (high)
      rises_.push_back({avr_->cycle, high_cycles_});
    else
      high_cycles_ += avr_->cycle - last_edge_;
    is_high_ = high;
    last_edge_ = avr_->cycle;
  }

  avr_t* avr_;
  std::deque<Rise> rises_;
  avr_cycle_count_t last_edge_ = 0, high_cycles_ = 0;
  bool is_high_ = false;
};

}  // namespace vm
