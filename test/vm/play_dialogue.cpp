// Plays a dialogue with the flashed program on a simulated Mega: `play_dialogue ELF FOLDER
// DIALOGUE`. At the end it prints measured figures, a line each. Exit code 0: all lines came as
// written, 1: a line differed, 2: the dialogue could not be played.
#include <cstdio>

#include "mega_player.h"

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "play_dialogue: give ELF FOLDER DIALOGUE\n");
    return 2;
  }
  try {
    world::World world(partsOfDialogues(), 1651);
    brain::MegaBrain mega(world, argv[1]);
    vm::MegaPlayer player(readScript(argv[2], argv[3]), world, mega);
    player.play();
    player.tellFigures();
    return 0;
  } catch (const Failure& failure) {
    std::fprintf(stderr, "%s\n", failure.what());
    return 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "play_dialogue: %s\n", error.what());
    return 2;
  }
}
