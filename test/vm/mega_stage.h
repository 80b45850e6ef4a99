// The flashed program on the stage of the dialogues: pins, wire and encoders of a simulated Mega
// stand between them. The stage itself is the same for the host's build of the firmware.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "pulse_meter.h"
#include "test_dialogues/stage.h"
#include "virtual_board.h"

namespace vm {

/// An encoder on two inputs of the Mega.
class EncoderPins {
 public:
  EncoderPins(int first, int second) : first_(first), second_(second) {}

  /// Where the count stands when the board starts; both channels are low there.
  void restart(uint16_t count) { count_ = start_ = count; }

  /// Edges that are still missing to a count, which wraps round.
  int missing(uint16_t count) const { return int16_t(count - count_); }

  /// Makes one edge towards a count, if any is missing.
  void step(VirtualBoard& board, uint16_t count);

 private:
  int first_, second_;
  uint16_t count_ = 0, start_ = 0;
};

/// Plays the dialogue of a stage with the flashed program.
class MegaStage {
 public:
  /// `elf`: the file that is flashed; throws std::runtime_error if it cannot be read.
  MegaStage(std::string elf, Stage& stage);

  /// From power-on to the dialogue's end, through every power cut in it; throws Failure.
  void live();

 private:
  void startBoard(const std::vector<uint8_t>& eeprom);
  void passMillisecond();
  void passWire();
  void showPins();
  void turnEncoders();
  int16_t dutyOf(machine::Axis axis) const;

  std::string elf_;
  Stage& stage_;
  std::unique_ptr<VirtualBoard> board_;
  std::unique_ptr<PulseMeter> spindle_, laser_;
  std::array<EncoderPins, machine::kAxisCount> encoders_;
  int since_driven_ms_[machine::kAxisCount] = {};
};

}  // namespace vm
