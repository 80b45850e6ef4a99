// Plays dialogues of test/dialogues with the flashed program on a simulated Mega:
// `play_dialogues ELF FOLDER DIALOGUE`. 0: all went as written, 1: something came otherwise, 2: it
// could not be tried.
#include <cstdio>

#include "mega_stage.h"

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "play_dialogues: give ELF FOLDER DIALOGUE\n");
    return 2;
  }
  try {
    Stage stage(readScript(argv[2], argv[3]));
    vm::MegaStage mega(argv[1], stage);
    mega.live();
    return 0;
  } catch (const Failure& failure) {
    std::fprintf(stderr, "%s\n", failure.what());
    return 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "play_dialogues: %s\n", error.what());
    return 2;
  }
}
