// A board on which the firmware runs a program dry: its motors are simulated by the firmware
// itself (B99), and time passes as fast as the host computes.
#pragma once

#include <deque>
#include <string>
#include <utility>
#include <vector>

#include "brain/simulated_eeprom.h"
#include "machine/machine.h"
#include "settings_flash.h"

namespace dry_run {

/// A move as the planner queued it.
struct Queued {
  int line;                  ///< of the program, counted from 0
  motion::Path<float> path;  ///< [mm]
  float z_from, z_to;        ///< [mm]
  float asked, feed, top;    ///< [mm/min] by the program, by $15, by every limit of the path
  bool by_chains;            ///< it moves a single chain: `path` holds chain lengths
  double ends;               ///< [s] when the sled reaches its end
};

/// A line, and what the machine said to it.
using Said = std::pair<int, std::string>;

/// The firmware, the computer that sends it lines, and a record of what it does with them.
class Stage : private machine::Wire,
              private machine::Drives,
              private machine::Aux,
              private machine::Clock {
 public:
  Stage();

  /// Sends lines as clients do: ahead of the answers, 126 characters at most. Returns when all are
  /// answered. Lines behind an alarm are left out.
  void send(const std::vector<std::string>& lines);
  /// Lets the queued moves end.
  void drain();

  const machine::Parts& parts() const { return machine_.parts(); }
  const std::vector<Queued>& moves() const { return moves_; }
  /// Forgets the moves whose set-points are all out; how many they were.
  size_t forgetEnded();
  const std::vector<Said>& said() const { return said_; }
  double seconds() const { return 1e-3 * double(now_ms_); }
  /// How many lines were answered.
  int answered() const { return answered_; }
  bool isHalted() const { return is_halted_; }

 private:
  int16_t read() override;
  void write(char character) override;
  uint8_t lost() override { return 0; }
  void drive(machine::Axis, int16_t) override {}
  void release(machine::Axis) override {}
  void brake(machine::Axis) override {}
  uint16_t count(machine::Axis) override { return 0; }
  uint16_t illegalSteps(machine::Axis) override { return 0; }
  void arrange(bool, uint8_t) override {}
  void set(machine::Output, bool) override {}
  void pulse(machine::Output, uint8_t) override {}
  void turnServo(uint8_t) override {}
  bool probeTouches() override;
  uint32_t milliseconds() override { return uint32_t(now_ms_); }
  void idle() override;
  void holdTicks() override {}
  void releaseTicks() override {}

  void take(const std::string& line);
  void noteQueued();
  void noteEnded();
  float asked(float feed, float way) const;
  void pass(int milliseconds);
  int untilTick() const { return tick_every_ms_ - int(now_ms_ % tick_every_ms_); }

  const FlashTable table_;
  SimulatedEeprom eeprom_;
  machine::Machine machine_;
  std::vector<Queued> moves_;
  std::vector<Said> said_;
  std::deque<char> on_the_way_, arrived_;
  std::deque<size_t> unanswered_;  ///< lengths of the lines that were sent
  size_t ahead_ = 0;               ///< sum of these
  std::string partial_;
  double byte_credit_ = 0;
  long now_ms_ = 0;
  int tick_every_ms_ = 10;
  int answered_ = 0, answered_at_rest_ = 0, whole_lines_ = 0, spare_ = 0;
  uint8_t waiting_ = 0;      ///< moves in the queue when they were last counted
  size_t ended_ = 0;         ///< moves whose set-points are all out
  float z_ = 0;              ///< [mm] where the last queued move ends
  bool is_started_ = false;  ///< ticks are due
  bool is_halted_ = false;
};

}  // namespace dry_run
