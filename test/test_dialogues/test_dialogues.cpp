// One test for each dialogue in test/dialogues/*.nc.
#include <gtest/gtest.h>

#include <filesystem>

#include "machine/machine.h"
#include "settings_flash.h"
#include "stage.h"

namespace {

const std::string kFolder = "test/dialogues";

std::vector<std::string> dialogues() {
  std::vector<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(kFolder))
    if (file.path().extension() == ".nc") names.push_back(file.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

/// One life of the machine, from power-on to power cut or the dialogue's end.
void liveOnce(Stage& stage) {
  const FlashTable table;
  machine::Machine machine({stage, stage, stage, stage, stage.eeprom, table}, {2, ""});
  stage.tick = [&] { machine.tick(); };
  machine.begin();
  for (;;) machine.loop();
}

void play(const std::string& name) {
  Stage stage(readScript(kFolder, name + ".nc"));
  for (;;) {
    try {
      liveOnce(stage);
    } catch (const PowerCut&) {
      stage.tick = [] {};
      stage.restart();
    } catch (const TheEnd&) {
      return;
    }
  }
}

class Dialogue : public testing::TestWithParam<std::string> {};

}  // namespace

TEST_P(Dialogue, IsAnsweredAsWritten) {
  try {
    play(GetParam());
  } catch (const Failure& failure) {
    FAIL() << failure.what();
  }
}

INSTANTIATE_TEST_SUITE_P(All, Dialogue, testing::ValuesIn(dialogues()),
                         [](const auto& info) { return info.param; });
