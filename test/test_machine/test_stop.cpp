// What a stop drops at once, and what the control tick shows.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "../settings_host/eeprom.h"
#include "board_at_rest.h"
#include "machine/machine.h"
#include "settings_flash.h"

using namespace machine;

namespace {

/// A board whose control clock ticks while the main program waits; its motors turn as driven.
struct TickingBoard : BoardAtRest {
  void idle() override {
    BoardAtRest::idle();
    if (!machine || now_ms % 10 != 0) return;
    machine->tick();
    // 20 turns a minute at full duty; a positive duty winds in.
    for (size_t i = 0; i < duty.size(); ++i) counted[i] = uint16_t(counted[i] - duty[i] / 9);
  }
  Machine* machine = nullptr;
};

struct Ticking {
  Ticking() {
    machine.begin();
    board.machine = &machine;
    for (const char* line : {"$17=2", "$7=2", "$8=139.1", "B06 L1800 R1800"}) run(line);
    board.said.clear();
    board.switched.clear();
  }

  void run(const std::string& lines) {
    board.input = lines + "\n";
    for (int i = 0; i < 200; ++i) machine.loop();
  }
  bool hasSaid(const char* text) const { return board.said.find(text) != std::string::npos; }
  bool hasSwitched(Output output, float level) const {
    for (size_t i = 0; i + 1 < board.switched.size(); i += 2)
      if (board.switched[i] == float(output) && board.switched[i + 1] == level) return true;
    return false;
  }

  TickingBoard board;
  settings_host::Eeprom eeprom;
  const FlashTable table;
  Machine machine{{board, board, board, board, eeprom, table}, {2, ""}};
};

}  // namespace

TEST(StopAtOnce, ForgetsTheLinesThatWait) {
  Ticking ticking;
  ticking.run("G4 P1\nM3");
  EXPECT_TRUE(ticking.hasSaid("Turning Spindle On")) << ticking.board.said;
  ticking.run("M5");
  ticking.board.said.clear();
  ticking.run("G4 P1\nM3\n!");
  EXPECT_FALSE(ticking.hasSaid("Turning Spindle On")) << ticking.board.said;
  EXPECT_TRUE(ticking.hasSaid("ok")) << ticking.board.said;
}

TEST(Tick, ShowsTheLaserOfTheMoveOnItsWay) {
  Ticking ticking;
  ticking.run("G91\nG1 X0.2 F300");
  EXPECT_FALSE(ticking.hasSwitched(Output::kLaser, 1)) << "not armed";
  ticking.run("M106\nG1 X0.2 F300");
  EXPECT_TRUE(ticking.hasSwitched(Output::kLaser, 1)) << ticking.board.said;
}
