// Characters as they come: quick characters act anywhere, lines wait, too long lines are reported.
#include <gtest/gtest.h>

#include "reading.h"

using namespace gcode;

namespace {

const int kAllFree = 127;  // characters, in the report for Maslow clients

/// Puts a text in; the quick characters among it as a text: `!`, `~`, X for a reset, O an overflow.
std::string put(Input& input, const std::string& text) {
  std::string quick;
  const char letters[] = " !~XO";
  for (const char character : text) {
    const Quick meant = input.put(character);
    if (meant != Quick::kNone) quick += letters[int(meant)];
  }
  return quick;
}

/// All complete lines, with a bar behind each.
std::string lines(Input& input) {
  std::string all;
  char line[Input::kRoom + 1];
  while (input.takeLine(line)) all += (input.wasTooLong() ? "(too long)" : std::string(line)) + "|";
  return all;
}

}  // namespace

TEST(Input, GivesLinesInOrderIncludingEmptyOnes) {
  Input input;
  EXPECT_EQ("", put(input, "G1 X5  \n\n  \nB05"));
  EXPECT_EQ("G1 X5  ||  |", lines(input));
  put(input, "  \n");
  EXPECT_EQ("B05  |", lines(input));
}

TEST(Quick, CharactersActInsideLinesAndComments) {
  Input input;
  EXPECT_EQ("~", put(input, "G1 X~5\n"));
  EXPECT_EQ("G1 X5|", lines(input));
  EXPECT_EQ("!", put(input, "(look out!)"));
  EXPECT_EQ("~", put(input, "; ~"));
}

TEST(Quick, CharactersSwallowTheLineFeedBehindThem) {
  Input input;
  put(input, "~\n!\n\x18\n`\n");
  EXPECT_EQ("", lines(input));
  put(input, "~\n\n");
  EXPECT_EQ("|", lines(input)) << "only one line feed";
  put(input, "~G1\n");
  EXPECT_EQ("G1|", lines(input)) << "another character begins a normal line";
  put(input, "G1 X5~?\n");
  EXPECT_EQ("G1 X5|", lines(input)) << "a question stands between";
}

TEST(Quick, CharactersFindRoomInAFullBuffer) {
  Input input;
  EXPECT_EQ("", put(input, std::string(125, 'G') + "\n"));
  EXPECT_EQ("~", put(input, "~\n"));
  EXPECT_EQ(125u + 1, lines(input).size());
}

TEST(Quick, AQuestionMarkAsksForTheStatusOutsideComments) {
  Input input;
  EXPECT_EQ(Quick::kStatus, input.put('?'));
  EXPECT_FALSE(input.isInLine());
  put(input, "G?1 X5?\n");
  EXPECT_EQ("G1 X5|", lines(input));
  put(input, "X1 (");
  EXPECT_EQ(Quick::kNone, input.put('?'));
  put(input, ") ;");
  EXPECT_EQ(Quick::kNone, input.put('?'));
  put(input, "\n?\n");
  EXPECT_EQ("X1 (?) ;?||", lines(input)) << "its line feed ends a line";
}

TEST(Input, MarksALineWithAControlCharacterAsAMistake) {
  for (const char each : {'\x00', '\x01', '\x0b', '\x10', '\x1f', '\x7f'}) {
    Input input;
    put(input, std::string("G0\nX1") + each + "0\n");
    EXPECT_EQ("G0|X1?0|", lines(input)) << int(each);
  }
  Input input;
  put(input, "X5 (a\x10) Y6\n");
  char line[Input::kRoom + 1];
  ASSERT_TRUE(input.takeLine(line));
  EXPECT_EQ(Fault::kNone, faultOf(line));
}

TEST(Input, EndsALineOnceAtCrOrLfOrBoth) {
  Input input;
  put(input, "X5\r\nX6\rX7\nX8\r \n\r\n\nX\r7\n");
  EXPECT_EQ("X5|X6|X7|X8|||X|7|", lines(input)) << "a minus that became a return leaves no number";
  EXPECT_EQ("!~X", put(input, "!\r\n~\r\n\x18\r\n"));
  EXPECT_EQ("", lines(input));
}

TEST(Input, SkipsALineThatAnUnreadableCharacterMakesTooLong) {
  Input input;
  put(input, std::string(125, 'X') + "\x10XX\nG1\n" + std::string(1000, '\x10') + "\n");
  EXPECT_EQ("(too long)|G1||", lines(input));
  put(input, "X" + std::string(1000, '\x10') + "\n");
  EXPECT_EQ("(too long)|", lines(input));
}

TEST(Input, DropsTheRestOfAnInterruptedLine) {
  for (const char* begun : {"G1 X10 ", "G1 X10 (a", "G1 X10 ;a", " ", "(", "G1\nG1 X10 "}) {
    Input input;
    put(input, begun);
    input.clear();
    EXPECT_EQ(kAllFree, input.room());
    put(input, "Y50 (a) ;b F900\nG1 X5\n");
    EXPECT_EQ("G1 X5|", lines(input)) << begun;
  }
  Input input;
  put(input, std::string(300, 'X'));
  input.clear();
  put(input, "Y50\nG1 X5\n");
  EXPECT_EQ("G1 X5|", lines(input)) << "no mark of a line that was too long is left";
  input.clear();
  put(input, "G1 X6\n");
  EXPECT_EQ("G1 X6|", lines(input)) << "between two lines nothing is cut";
}

TEST(Input, EndsAnInterruptedLineEvenAfterTheStop) {
  for (const char* stop : {"!", "\x18", "`"}) {
    Input input;
    put(input, std::string("G1 X10") + stop);
    input.clear();
    put(input, "\nG1 X5\n");
    EXPECT_EQ("G1 X5|", lines(input)) << int(*stop);
  }
}

TEST(Quick, BytesActInsideCutOrTooLongLines) {
  Input input;
  put(input, "(a");
  input.clear();
  EXPECT_EQ(Quick::kHold, input.put('\x84'));
  put(input, "\n" + std::string(200, '('));
  EXPECT_EQ(Quick::kHold, input.put('\x84'));
}

TEST(Quick, BytesForOtherMachinesAreDropped) {
  for (int byte = 0x80; byte < 0x100; ++byte) {
    if (byte == 0x84 || byte == 0x85 || (byte >= 0x90 && byte <= 0x9d)) continue;
    Input input;
    EXPECT_EQ(Quick::kNone, input.put(char(byte)));
    EXPECT_EQ(kAllFree, input.room()) << byte;
    EXPECT_EQ(Quick::kHold, input.put('\x84')) << byte;
    put(input, "G1 X5\n");
    EXPECT_EQ("G1 X5|", lines(input)) << byte;
  }
  Input input;
  put(input, "G1 \x9eX\xc2\xa0");
  EXPECT_EQ(Quick::kFeedUp, input.put('\x91'));
  EXPECT_EQ(Quick::kNone, input.put('\xc2'));
  EXPECT_EQ(Quick::kHold, input.put('\x84'));
  put(input, "5\x80\xa1\n");
  EXPECT_EQ("G1 X5|", lines(input));
}

TEST(Input, MarksADigitWithAFlippedBitAsAMistake) {
  for (const char each : std::string("0123456789.-+")) {
    Input input;
    put(input, std::string("G1 X1") + char(each ^ 0x80) + "\n");
    EXPECT_EQ("G1 X1?|", lines(input)) << each;
  }
}

TEST(Input, TurnsATabIntoASpace) {
  Input input;
  put(input, "X1\tY2\n");
  EXPECT_EQ("X1 Y2|", lines(input));
}

TEST(Input, HoldsTheBufferThatGrblSendersCountOn) {
  Input input;
  const std::string line = "G1 X12345 Y1234";
  std::string all, expected;
  for (int i = 0; i < 8; ++i) all += line + "\n", expected += line + "|";
  EXPECT_EQ(128u, all.size());
  for (int round = 0; round < 9; ++round) {
    EXPECT_EQ("", put(input, all));
    EXPECT_EQ(8, input.lines());
    EXPECT_EQ(expected, lines(input));
    put(input, "G4\n");
    lines(input);
  }
}

TEST(Input, AcceptsALineOfAHundredAndTwentySixCharacters) {
  Input input;
  EXPECT_EQ("", put(input, std::string(126, 'X') + "\n"));
  EXPECT_EQ(std::string(126, 'X') + "|", lines(input));
}

TEST(Input, SkipsATooLongLineAndReportsItOnce) {
  Input input;
  EXPECT_EQ("", put(input, std::string(127, 'X') + "\nG1\n"));
  EXPECT_EQ("(too long)|G1|", lines(input));
  EXPECT_EQ("", put(input, std::string(1000, 'X') + "\nG1\n"));
  EXPECT_EQ("(too long)|G1|", lines(input));
}

TEST(Resume, AppliesToLinesThatEndedBeforeIt) {
  Input input;
  char line[Input::kRoom + 1];
  EXPECT_FALSE(input.takeResume());
  put(input, "G1\nM0\n~\nM1\n");
  input.takeLine(line);
  input.takeLine(line);
  EXPECT_TRUE(input.takeResume());
  // A `~` counts once.
  EXPECT_FALSE(input.takeResume());
  input.takeLine(line);
  EXPECT_FALSE(input.takeResume());
}

TEST(Resume, IsForgottenWithTheLines) {
  Input input;
  put(input, "M0\n~");
  input.clear();
  EXPECT_FALSE(input.takeResume());
}

TEST(Quick, BytesAbove127HoldAndChangeTheFeed) {
  Input input;
  EXPECT_EQ(Quick::kHold, input.put('\x84'));
  EXPECT_EQ(Quick::kFeedUsual, Input().put('\x90'));
  EXPECT_EQ(Quick::kFeedUp, Input().put('\x91'));
  EXPECT_EQ(Quick::kFeedDown, Input().put('\x92'));
  EXPECT_EQ(Quick::kFeedUpOne, Input().put('\x93'));
  EXPECT_EQ(Quick::kFeedDownOne, Input().put('\x94'));
  EXPECT_EQ(Quick::kJogCancel, Input().put('\x85'));
  EXPECT_EQ(Quick::kRapidFull, Input().put('\x95'));
  EXPECT_EQ(Quick::kRapidQuarter, Input().put('\x97'));
  EXPECT_EQ(Quick::kSpindleUsual, Input().put('\x99'));
  EXPECT_EQ(Quick::kSpindleDownOne, Input().put('\x9d'));
  for (const int byte : {0x83, 0x86, 0x8f, 0x9e, 0xff})
    EXPECT_EQ(Quick::kNone, Input().put(char(byte))) << byte;
  Input line;
  put(line, "G1 X");
  EXPECT_EQ(Quick::kHold, line.put('\x84'));
  put(line, "5\n");
  EXPECT_EQ("G1 X5|", lines(line));
  // One after the other.
  EXPECT_EQ(Quick::kFeedDown, line.put('\x92'));
  EXPECT_EQ(Quick::kFeedDown, line.put('\x92'));
}

TEST(Quick, BytesInsideUtf8CommentsAreIgnored) {
  Input input;
  EXPECT_EQ("", put(input, ";\xc3\x84\x92 (\xc2\x84\n(\x91 ; \xe2\x80\x93)\n"));
  lines(input);
  EXPECT_EQ(Quick::kHold, input.put('\x84'));
  put(input, "G1\n;(\n");
  EXPECT_EQ(Quick::kFeedUp, input.put('\x91'));
  put(input, "(");
  input.clear();
  EXPECT_EQ(Quick::kHold, input.put('\x84'));
}
