// The first start on a machine that ran the published firmware: settings and chains are taken over.
#include <gtest/gtest.h>

#include "life.h"
#include "test_settings/published_image.h"

namespace {

/// Says these lines, in this order, with others between them.
void expectSaid(Stage& stage) {
  try {
    live(stage);
  } catch (const Failure& failure) {
    FAIL() << failure.what();
  }
}

std::vector<Step> skipsTo(std::initializer_list<const char*> lines) {
  std::vector<Step> steps;
  for (const char* line : lines)
    steps.push_back({line[0] == '-' ? Step::kSend : Step::kSkipTo, line + (line[0] == '-'), line});
  steps.push_back({Step::kAsk, "answers from now", "end"});
  return steps;
}

void put(Stage& stage, const Eeprom& image) {
  for (uint16_t at = 0; at < 4096; ++at) stage.eeprom.bytes[at] = image.read(at);
}

}  // namespace

TEST(FirstStart, TakesOverThePublishedFirmwaresSettingsAndPosition) {
  Eeprom image = publishedImage(true);
  const uint32_t counts = 270000;  // 2107.5 mm of chain on that machine
  storeLow(image, 310, counts, 4);
  storeLow(image, 314, counts, 4);
  Stage stage(skipsTo({"Settings of the published firmware were taken over.", "ready", "ok",
                       "position loaded at:", "5.12 within 0.02", "-$$", "$2=3602.6 (*",
                       "$12=8148 (*", "$42=2000 (*", "ok", "-B10 L", "[Measure: 2107.51]", "ok"}));
  put(stage, image);
  expectSaid(stage);
}

TEST(FirstStart, SaysWhichOtherFirmwareItDoesNotRead) {
  Eeprom image = publishedImage(true);
  image[300] = 6;
  Stage stage(
      skipsTo({"error: Settings of another firmware, version 6, are not read. Using "
               "default settings.",
               "ready", "ok", "Chain lengths are not known yet*", "-$$", "$2=2978.4 (*", "ok"}));
  put(stage, image);
  expectSaid(stage);
}

TEST(FirstStart, SaysWhichSettingCannotBeRight) {
  Eeprom image = publishedImage(true);
  storeSetting(image, kBlock[2], -5);
  Stage stage(
      skipsTo({"error: The published firmware's $2 cannot be right; none was taken over. "
               "Using default settings.",
               "ready", "ok", "-$$", "$2=2978.4 (*", "ok"}));
  put(stage, image);
  expectSaid(stage);
}
