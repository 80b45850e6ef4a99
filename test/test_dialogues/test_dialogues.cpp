// One test for each dialogue in test/dialogues/*.nc.
#include <gtest/gtest.h>

#include <filesystem>

#include "life.h"

namespace {

const std::string kFolder = "test/dialogues";

std::vector<std::string> dialogues() {
  std::vector<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(kFolder))
    if (file.path().extension() == ".nc") names.push_back(file.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

class Dialogue : public testing::TestWithParam<std::string> {};

}  // namespace

TEST_P(Dialogue, IsAnsweredAsWritten) {
  try {
    Stage stage(readScript(kFolder, GetParam() + ".nc"));
    live(stage);
  } catch (const Failure& failure) {
    FAIL() << failure.what();
  }
}

TEST_P(Dialogue, IsAnsweredAsWrittenWhereverTicksFall) {
  try {
    Stage stage(readScript(kFolder, GetParam() + ".nc"));
    stage.letTicksFallAnywhere(uint32_t(std::hash<std::string>()(GetParam())));
    live(stage);
  } catch (const Failure& failure) {
    FAIL() << failure.what();
  }
}

INSTANTIATE_TEST_SUITE_P(All, Dialogue, testing::ValuesIn(dialogues()),
                         [](const auto& info) { return info.param; });
