// Plays every dialogue of test/dialogues against the machine, each in its own simulated world.
#include <gtest/gtest.h>

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
