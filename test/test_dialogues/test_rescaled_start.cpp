// Counts that were kept under other scales of the encoders say nothing about the chains.
#include <gtest/gtest.h>

#include "awakened.h"
#include "host_machine.h"
#include "settings_flash.h"

namespace {

/// The EEPROM of a machine that rests at 0,0, once all settings are stored: 5 s on a fresh board.
SimulatedEeprom restingAtZero() {
  std::vector<Step> steps = readScript("test/dialogues", "setup.inc");
  steps.push_back({Step::kAsk, "wait 8", "end"});
  HostMachine machine(steps);
  EXPECT_EQ("", machine.play());
  return machine.brain.memory();
}

/// Sets a setting in the EEPROM alone, as a start does that finds a value beyond its limits.
Belief awakenWith(SimulatedEeprom eeprom, uint8_t number, float value) {
  const FlashTable table;
  float room[kSettingCount];
  settings::Values values(table, room);
  settings::Memory memory(eeprom, values);
  memory.start();
  EXPECT_EQ(settings::Refusal::kNone, memory.set(number, value));
  while (!memory.isIdle()) {
    memory.step();
    eeprom.advance(1000);
  }
  return awaken(eeprom.bytes);
}

}  // namespace

TEST(RescaledStart, ForgetsThePositionUntilChainsAreSet) {
  const SimulatedEeprom eeprom = restingAtZero();
  for (const auto& [number, value] :
       {std::pair<uint8_t, float>{12, 8113.74f}, {13, 63.6f}, {19, 3.2f}, {20, 7561}}) {
    const Belief belief = awakenWith(eeprom, number, value);
    EXPECT_FALSE(belief.is_known) << int(number);
    EXPECT_NE(std::string::npos, belief.said.find("Encoders are scaled otherwise")) << belief.said;
  }
  const Belief belief = awakenWith(eeprom, 15, 700);
  EXPECT_TRUE(belief.is_known) << belief.said;
}
