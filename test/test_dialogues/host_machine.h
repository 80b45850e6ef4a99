// The host's build of the firmware in its garage, and a dialogue that is played with it.
#pragma once

#include <string>
#include <vector>

#include "brain/host_brain.h"
#include "player.h"

/// The machine of dialogues with motors drawn by a seed; 0: nominal motors.
inline world::Parts withMotors(unsigned seed) {
  world::Parts parts = partsOfDialogues();
  parts.seed = seed;
  return parts;
}

/// A machine with chains of `paid_out` [mm].
struct HostMachine {
  explicit HostMachine(std::vector<Step> steps, double paid_out = 1651,
                       const machine::BoardName& board = {2, "", machine::Start::kUsual},
                       unsigned motors = 0)
      : world(withMotors(motors), paid_out),
        brain(world, board),
        player(std::move(steps), world, brain) {}

  /// Plays the dialogue to its end; what went wrong, or nothing.
  std::string play() {
    try {
      player.play();
    } catch (const Failure& failure) {
      return failure.what();
    }
    return "";
  }

  /// Begins with the bytes of another memory.
  void copyMemory(const settings::Bytes& memory) {
    std::vector<uint8_t> bytes;
    for (uint16_t at = 0; at < 4096; ++at) bytes.push_back(memory.read(at));
    brain.setEeprom(bytes);
  }

  world::World world;
  brain::HostBrain brain;
  Player player;
};
