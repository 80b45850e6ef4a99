// When the main program hangs, the control tick switches spindle and laser off at once.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "../settings_host/eeprom.h"
#include "board_at_rest.h"
#include "machine/machine.h"
#include "settings_flash.h"

using namespace machine;

namespace {

/// A machine that has done these lines.
struct Working {
  explicit Working(const std::string& lines) {
    machine.begin();
    board.input = lines;
    for (int i = 0; i < 50; ++i) machine.loop();
    board.switched.clear();
    board.said.clear();
  }

  BoardAtRest board;
  settings_host::Eeprom eeprom;
  const FlashTable table;
  Machine machine{{board, board, board, board, eeprom, table}, {2, ""}};
};

const float kSpindlePin = float(Output::kSpindle), kLaserPin = float(Output::kLaser);

}  // namespace

TEST(HungProgram, SwitchesLaserAndSpindleOffAtOnce) {
  Working high("$17=2\nM3\n"), low("$17=3\nM3\n");
  high.machine.noteHang();
  EXPECT_EQ((std::vector<float>{kLaserPin, 0, kSpindlePin, 0}), high.board.switched);
  low.machine.noteHang();
  EXPECT_EQ((std::vector<float>{kLaserPin, 0, kSpindlePin, 1}), low.board.switched);
}

TEST(HungProgram, SaysSoWhenItComesBack) {
  Working working("$17=2\nM3\n");
  working.machine.noteHang();
  EXPECT_EQ("", working.board.said) << "an interrupt writes nothing";
  working.machine.loop();
  EXPECT_NE(std::string::npos, working.board.said.find("ALARM: The firmware was busy for too long"))
      << working.board.said;
  working.board.said.clear();
  for (int i = 0; i < 50; ++i) working.machine.loop();
  EXPECT_EQ(std::string::npos, working.board.said.find("ALARM")) << working.board.said;
}
