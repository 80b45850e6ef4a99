// One test for each dialogue in test/dialogues/*.nc, and for each program as common CAM writes
// them; what the player accepts, and what it refuses.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "host_machine.h"
#include "line_match.h"

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

namespace {

/// The failure of a dialogue of these lines; empty if it is answered as written.
std::string wrongIn(const std::string& lines) {
  const std::filesystem::path folder = testing::TempDir();
  std::ofstream(folder / "asked.nc") << lines;
  return HostMachine(readScript(folder.string(), "asked.nc")).play();
}

/// Steps behind the start of the usual machine.
std::string wrongBehindSetup(const std::string& lines) {
  std::ifstream setup("test/dialogues/setup.inc");
  const std::string begin{std::istreambuf_iterator<char>(setup), {}};
  return wrongIn(begin + lines);
}

}  // namespace

TEST(Line, MatchesLetterByLetterOrWithinATolerance) {
  EXPECT_TRUE(matches("a 1.25, b", readExpected("a 1.20, b within 0.06")));
  EXPECT_FALSE(matches("a 1.3", readExpected("a 1 within 0.2")));
  EXPECT_TRUE(matches("left 5 of 6", readExpected("left #*")));
  EXPECT_FALSE(matches("left", readExpected("left #")));
  EXPECT_TRUE(matches("whole", readExpected("whole")));
  EXPECT_FALSE(matches("whole line", readExpected("whole")));
}

TEST(APlayer, FailsAtALineThatDiffers) {
  const std::string wrong = wrongIn("<* ready\n<- ok\n<- Settings of a friend*\n");
  EXPECT_EQ(0u, wrong.find("asked.nc:3: Settings of a friend*\n  came instead: ")) << wrong;
  EXPECT_NE("", wrongIn("<* never said\n"));
  EXPECT_NE("", wrongIn("<* ready\n")) << "a line too many";
}

TEST(APlayer, FailsWhenTheMachineDiffers) {
  const std::string in_motion = "-> G1 X50 F600\n<- ok\n~~ wait 1\n~~ ";
  EXPECT_EQ("", wrongBehindSetup(in_motion + "on left at once\n~~ laser low\n~~ quiet\n"));
  for (const char* question :
       {"off left", "off left at once", "sled X1 Y0 within 0.5", "chains L1651 R1651 0.1",
        "z 1 0.5", "laser high", "spindle 40 2", "servo 30", "status <Hold* within 0.1",
        "errors [PE:9*", "halts 1", "answers 3", "wound left", "hold 0.001 mm", "undriven"})
    EXPECT_NE("", wrongBehindSetup(in_motion + question)) << question;
  EXPECT_EQ("", wrongBehindSetup("~~ wait 0.5\n~~ off left at once\n~~ undriven"));
  EXPECT_NE("", wrongBehindSetup("~~ wait 0.5\n~~ on left"));
  EXPECT_NE("", wrongBehindSetup("-> B05\n~~ wait 0.2\n~~ quiet"));
}

TEST(APlayer, RefusesWhatItDoesNotUnderstand) {
  EXPECT_NE(std::string::npos, wrongIn("<* ok\n~~ dance\n").find("nobody understands dance"));
  EXPECT_NE("", wrongIn("<* ok\n~~ off front\n"));
  EXPECT_NE("", wrongIn("<* ok\n~~ sled X1\n"));
  EXPECT_THROW(wrongIn("== ok\n"), std::runtime_error);
}

TEST(APlayer, FailsWhenTheFirmwareFallsSilent) {
  HostMachine machine(readScript("test/dialogues", "setup.inc"));
  machine.player.look = [&] { machine.brain.delayProgram(3000); };
  EXPECT_NE(std::string::npos, machine.play().find("silence"));
}
