// What M3 and M5 do with each kind of spindle, and how long they take.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "../settings_host/eeprom.h"
#include "board_at_rest.h"
#include "machine/machine.h"
#include "settings_flash.h"

using namespace machine;

namespace {

/// Notes when the servo was turned.
struct ServoBoard : BoardAtRest {
  void turnServo(uint8_t degrees) override {
    BoardAtRest::turnServo(degrees);
    turned_ms.push_back(now_ms);
  }
  std::vector<uint32_t> turned_ms;
};

struct Shop {
  explicit Shop(const std::string& kind) {
    machine.begin();
    run("$17=" + kind);
    board.switched.clear();
    board.servo.clear();
    board.turned_ms.clear();
  }

  /// Does a line; the time it took [ms].
  uint32_t run(const std::string& line) {
    for (int i = 0; i < 5; ++i) machine.loop();
    board.said.clear();
    board.input = line + "\n";
    const uint32_t begin = board.now_ms;
    while (board.said.find("ok") == std::string::npos && board.now_ms - begin < 60000)
      machine.loop();
    return board.now_ms - begin;
  }

  bool hasSaid(const char* text) const { return board.said.find(text) != std::string::npos; }

  ServoBoard board;
  settings_host::Eeprom eeprom;
  const FlashTable table;
  Machine machine{{board, board, board, board, eeprom, table}, {2, ""}};
};

const float kPin = float(Output::kSpindle);

}  // namespace

TEST(SpindleCommands, ServoTurnsToTheSwitchAndBack) {
  Shop shop("1");
  EXPECT_NEAR(shop.run("M3"), 7000, 50) << "three turns of 2 s, and 1 s for the spindle";
  EXPECT_EQ((std::vector<uint8_t>{90, 180, 90, kNoServo}), shop.board.servo);
  ASSERT_EQ(4u, shop.board.turned_ms.size());
  for (int i = 1; i < 4; ++i)
    EXPECT_NEAR(shop.board.turned_ms[i] - shop.board.turned_ms[i - 1], 2000, 5) << i;
  EXPECT_TRUE(shop.hasSaid("Turning Spindle On")) << shop.board.said;
  shop.board.servo.clear();
  EXPECT_NEAR(shop.run("M5"), 7000, 50);
  EXPECT_EQ((std::vector<uint8_t>{90, 0, 90, kNoServo}), shop.board.servo);
  EXPECT_TRUE(shop.hasSaid("Turning Spindle Off")) << shop.board.said;
}

TEST(SpindleCommands, RelaySwitchesAndWaitsForTheSpindle) {
  for (const char* kind : {"2", "3"}) {
    Shop shop(kind);
    const float on = kind[0] == '2' ? 1 : 0;
    EXPECT_NEAR(shop.run("M3"), 1000, 50) << kind;
    EXPECT_EQ((std::vector<float>{kPin, on}), shop.board.switched) << kind;
    shop.board.switched.clear();
    EXPECT_NEAR(shop.run("M5"), 1000, 50) << kind;
    EXPECT_EQ((std::vector<float>{kPin, 1 - on}), shop.board.switched) << kind;
    EXPECT_EQ(0u, shop.board.servo.size()) << kind;
  }
}

TEST(SpindleCommands, WithoutASpindleNothingHappens) {
  Shop shop("0");
  EXPECT_LT(shop.run("M3"), 50u);
  EXPECT_EQ(0u, shop.board.switched.size());
  EXPECT_EQ(0u, shop.board.servo.size());
  EXPECT_FALSE(shop.hasSaid("Spindle")) << shop.board.said;
}
