// What the player of dialogues accepts, and what it refuses.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "host_machine.h"
#include "line_match.h"

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
