// Runs board_program.cpp, or another program for MS milliseconds, on the simulated Mega and prints
// the lines that it sends: `check_board ELF [MS]`.
#include <cstdio>
#include <cstdlib>

#include "mega/virtual_board.h"

int main(int argc, char** argv) try {
  if (argc != 2 && argc != 3) return 2;
  vm::VirtualBoard board(argv[1]);
  board.setPin(2, true);
  board.setPin(3, true);
  // Low only after the program has set up its interrupts; a line takes 2 ms.
  board.runMs(10);
  board.setPin(2, false);
  board.setPin(3, false);
  board.runMs(argc == 3 ? std::atoi(argv[2]) : 60);
  for (const std::string& line : board.lines) std::printf("%s\n", line.c_str());
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "check_board: %s\n", error.what());
  return 2;
}
