// One test for each dialogue in test/dialogues/*.nc.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "host_machine.h"

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

TEST_P(Dialogue, IsAnsweredAsWrittenWhereverTicksFall) {
  HostMachine machine(readScript(kFolder, GetParam() + ".nc"));
  machine.brain.letTicksFallAnywhere(uint32_t(std::hash<std::string>()(GetParam())));
  EXPECT_EQ("", machine.play());
}

INSTANTIATE_TEST_SUITE_P(All, Dialogue, testing::ValuesIn(dialogues()),
                         [](const auto& info) { return info.param; });
