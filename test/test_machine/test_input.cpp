// Characters become lines; quick ones act at once; nothing that is too long does harm.
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "machine/input.h"

using namespace machine;

namespace {

/// Puts a text and tells what its quick characters were.
std::vector<Quick> put(Input& input, const std::string& text) {
  std::vector<Quick> told;
  for (const char character : text) {
    const Quick quick = input.put(character);
    if (quick != Quick::kNone) told.push_back(quick);
  }
  return told;
}

std::vector<std::string> lines(Input& input) {
  std::vector<std::string> taken;
  char line[Input::kRoom + 1];
  while (input.takeLine(line)) taken.push_back(input.wasTooLong() ? "(too long)" : line);
  return taken;
}

typedef std::vector<std::string> Lines;

}  // namespace

TEST(Input, GivesLinesInOrder) {
  Input input;
  put(input, "G1 X5\r\n\n B05  \nG0");
  EXPECT_EQ(lines(input), (Lines{"G1 X5", "", " B05  "}));
  put(input, " Y1\n");
  EXPECT_EQ(lines(input), Lines{"G0 Y1"});
}

TEST(Input, TakesQuickCharactersOutOfLinesAndTheLineEndBehindThem) {
  Input input;
  EXPECT_EQ(put(input, "G1 !X5\n~\n`\n\x18\n?G4\n"),
            (std::vector<Quick>{Quick::kStop, Quick::kResume, Quick::kReset, Quick::kReset}));
  EXPECT_EQ(lines(input), (Lines{"G1 X5", "G4"}));
}

TEST(Input, HoldsTheCharactersThatClientsCountOn) {
  Input input;
  EXPECT_EQ(input.room(), 127);
  std::string many;
  for (int i = 0; i < 9; ++i) many += "G1 X1 Y12.5 Z\n";
  ASSERT_EQ(many.size(), 126u);
  EXPECT_TRUE(put(input, many).empty());
  EXPECT_EQ(put(input, "~"), std::vector<Quick>{Quick::kResume});
  EXPECT_EQ(input.room(), 1);
  EXPECT_EQ(lines(input).size(), 9u);
}

TEST(Input, SaysWhenALineIsLostForWantOfRoom) {
  Input input;
  std::vector<Quick> told;
  for (int i = 0; i < 20; ++i)
    for (const Quick quick : put(input, "G1 X1 Y1\n")) told.push_back(quick);
  EXPECT_FALSE(told.empty());
  EXPECT_EQ(told.front(), Quick::kOverflow);
}

TEST(Input, SwallowsALineThatIsTooLongAndOnlyThat) {
  Input input;
  EXPECT_TRUE(put(input, "G1 " + std::string(500, '1') + "\nG0\n").empty());
  EXPECT_EQ(lines(input), (Lines{"(too long)", "G0"}));
  put(input, std::string(126, 'X') + "\n");
  EXPECT_EQ(lines(input).front().size(), 126u);
}

TEST(Input, SurvivesAnyNoise) {
  Input input;
  std::mt19937 random(2);
  for (int i = 0; i < 300000; ++i) {
    input.put(char(random() % 97 == 0 ? '\n' : random() % 256));
    ASSERT_LE(input.room(), 127);
    if (random() % 50 == 0) lines(input);
    if (random() % 1000 == 0) input.clear();
  }
  put(input, "\n");
  lines(input);
  put(input, "\nG1\n");
  EXPECT_EQ(lines(input).back(), "G1");
}
