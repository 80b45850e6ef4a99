// The flashed program on the stage of the dialogues. Pins, serial line and encoders of a simulated
// Mega connect them. The stage is the same as for the host's build of the firmware.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mega/pins.h"
#include "mega/pulse_meter.h"
#include "mega/virtual_board.h"
#include "test_dialogues/stage.h"

namespace vm {

/// Plays the dialogue of a stage with the flashed program.
class MegaStage {
 public:
  /// `elf`: the file that is flashed; throws std::runtime_error if it cannot be read.
  MegaStage(std::string elf, Stage& stage);

  /// From power-on to the dialogue's end, through every power cut in it; throws Failure.
  void live();

  /// The Mega's memory, by address.
  const uint8_t* ram() const { return board_->avr()->data; }

 private:
  void startBoard(const std::vector<uint8_t>& eeprom);
  void passMillisecond();
  void passWire();
  void showPins();
  void turnEncoders();

  std::string elf_;
  Stage& stage_;
  std::unique_ptr<VirtualBoard> board_;
  std::unique_ptr<PulseMeter> spindle_, laser_;
  Encoders encoders_;
  int since_driven_ms_[machine::kAxisCount] = {};
};

}  // namespace vm
