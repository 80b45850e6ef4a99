// The first start on a machine that ran the published firmware: settings and chains are taken over.
#include <gtest/gtest.h>

#include "host_machine.h"
#include "settings_host/published_image.h"

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
