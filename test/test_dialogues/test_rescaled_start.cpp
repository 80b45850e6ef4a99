// A start on a machine that ran the published firmware, whose settings and chains are taken over;
// and on counts of other scales of the encoders, which say nothing about the chains.
#include <gtest/gtest.h>

#include "awakened.h"
#include "host_machine.h"
#include "settings_flash.h"
#include "settings_host/published_image.h"

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

namespace {

/// A machine with this memory says these lines, in this order, with others between them.
void expectSaid(const Eeprom& image, std::initializer_list<const char*> lines) {
  std::vector<Step> steps;
  for (const char* line : lines)
    steps.push_back({line[0] == '-' ? Step::kSend : Step::kSkipTo, line + (line[0] == '-'), line});
  steps.push_back({Step::kAsk, "answers from now", "end"});
  HostMachine machine(steps);
  machine.copyMemory(image);
  EXPECT_EQ("", machine.play());
}

}  // namespace

TEST(FirstStart, TakesOverThePublishedFirmwaresSettingsAndPosition) {
  Eeprom image = publishedImage(true);
  const uint32_t counts = 270000;  // 2107.5 mm of chain on that machine
  storeLow(image, 310, counts, 4);
  storeLow(image, 314, counts, 4);
  expectSaid(image, {"Settings of the published firmware were taken over.", "ready", "ok",
                     "position loaded at:", "5.12 within 0.02", "-$$", "$2=3602.6 (*",
                     "$12=8148 (*", "$42=2000 (*", "ok", "-B10 L", "[Measure: 2107.51]", "ok"});
}

TEST(FirstStart, SaysWhichOtherFirmwareItDoesNotRead) {
  Eeprom image = publishedImage(true);
  image[300] = 6;
  expectSaid(image,
             {"error: Settings of another firmware, version 6, are not read. Using "
              "default settings.",
              "ready", "ok", "Chain lengths are not known yet*", "-$$", "$2=2978.4 (*", "ok"});
}

TEST(FirstStart, SaysWhichSettingCannotBeRight) {
  Eeprom image = publishedImage(true);
  storeSetting(image, kBlock[2], -5);
  expectSaid(image, {"error: The published firmware's $2 cannot be right; none was taken over. "
                     "Using default settings.",
                     "ready", "ok", "-$$", "$2=2978.4 (*", "ok"});
}
