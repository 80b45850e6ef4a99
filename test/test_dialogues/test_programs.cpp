// Programs as common CAM writes them: each line is done, and the sled goes where the program says.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <sstream>

#include "host_machine.h"

namespace {

const std::string kPrograms = "test/programs/";

std::vector<std::string> programs() {
  std::vector<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(kPrograms)) {
    const std::filesystem::path& path = file.path();
    if (path.extension() != ".places" && path.extension() != ".md")
      names.push_back(path.filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// Questions for each line of a program that its places ask about.
std::multimap<int, std::string> questionsOf(const std::string& program) {
  const std::string name = std::filesystem::path(program).replace_extension(".places").string();
  std::ifstream text(kPrograms + name);
  std::multimap<int, std::string> questions;
  for (std::string row; std::getline(text, row);) {
    std::istringstream numbers(row);
    int line;
    std::string x, y, z;
    if (!(numbers >> line >> x >> y >> z)) continue;
    questions.insert({line, "sled X" + x + " Y" + y + " within 0.06"});
    questions.insert({line, "z " + z + " within 0.02"});
  }
  return questions;
}

/// The lines of a program, each sent when the line before was answered.
std::vector<Step> stepsOf(const std::string& program) {
  std::vector<Step> steps = readScript("test/dialogues", "setup.inc");
  const std::multimap<int, std::string> questions = questionsOf(program);
  if (questions.empty()) throw std::runtime_error(program + " has no places");
  std::ifstream text(kPrograms + program);
  int number = 0;
  const auto step = [&](Step::Kind kind, const std::string& text) {
    steps.push_back({kind, text, program + ":" + std::to_string(number)});
  };
  for (std::string line; std::getline(text, line);) {
    ++number;
    step(Step::kSend, line);
    const bool waits =
        line.find("M6") != std::string::npos || line.find("M06") != std::string::npos;
    if (waits) step(Step::kSkipTo, "Maslow Paused");
    if (waits) step(Step::kSend, "~");
    for (int answers = waits ? 2 : 1; answers > 0; --answers) step(Step::kSkipTo, "ok");
    const auto asked = questions.equal_range(number);
    if (asked.first == asked.second) continue;
    step(Step::kSend, "G4 P300");
    step(Step::kSkipTo, "ok");
    for (auto at = asked.first; at != asked.second; ++at) step(Step::kAsk, at->second);
  }
  return steps;
}

class Program : public testing::TestWithParam<std::string> {};

}  // namespace

TEST_P(Program, EndsInTheRightPlaces) { EXPECT_EQ("", HostMachine(stepsOf(GetParam())).play()); }

INSTANTIATE_TEST_SUITE_P(All, Program, testing::ValuesIn(programs()), [](const auto& info) {
  return std::filesystem::path(info.param).stem().string();
});
