// Plays dialogues of test/dialogues with the flashed program on a simulated Mega:
// `play_dialogues ELF FOLDER DIALOGUE`. Exit code 0: all lines came as written, 1: a line differed,
// 2: the dialogue could not be played.
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
