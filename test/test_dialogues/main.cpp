// Plays every dialogue of test/dialogues against the machine, each in a new simulated world.
#include <gtest/gtest.h>

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
