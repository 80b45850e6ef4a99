// Lines cut into commands: each row of the tables of what clients send.
#include <gtest/gtest.h>

#include "reading.h"

using namespace gcode;

TEST(Pieces, KeepWordsBeforeTheFirstCode) {
  EXPECT_EQ("- M3", codesOf("S12000 M3"));
  EXPECT_EQ(12000, piecesOf("S12000 M3").at(0).words.value('S'));
  EXPECT_EQ("-", codesOf("F500"));
  EXPECT_EQ("-", codesOf("X5 Y6"));
}

TEST(Pieces, OfAnEmptyLineThereAreNone) {
  for (const char* line : {"", "  ", "%", "(c)", "; c", "N5"}) EXPECT_EQ("", codesOf(line)) << line;
}

TEST(Code, ThatIsUnknownIsAccepted) {
  for (const char* line : {"G54", "G92", "G28", "G64", "G80", "G94", "G17", "M7", "M8", "M999"})
    EXPECT_EQ(Fault::kNone, faultOf(line)) << line;
}

TEST(Code, ThatIsImpossibleIsAMistake) {
  for (const char* line : {"G-1", "G0.05 X5", "G1.04 X5", "M1000", "G1e9"})
    EXPECT_EQ(Fault::kNoCode, faultOf(line)) << line;
}

TEST(Mistake, IsFoundBeforeAnythingRuns) {
  EXPECT_EQ(Fault::kNoNumber, faultOf("G0 X5 G1 Y6 M"));
  EXPECT_EQ('M', findMistake("G0X5G1Y6M").letter);
}

TEST(Pieces, TakeCoordinatesFromAnywhereInTheLine) {
  EXPECT_EQ("G91 G28", codesOf("G28 G91 Z0"));
  const std::vector<Piece> home = piecesOf("G28 G91 Z0 G90");
  ASSERT_EQ(3u, home.size());
  EXPECT_EQ("G91 G28 G90", codesOf("G28 G91 Z0 G90"));
  EXPECT_FALSE(home.at(0).words.hasPlace());
  EXPECT_TRUE(home.at(1).words.has('Z'));
  EXPECT_EQ("G90 G10", codesOf("G10 G90 L2 P3 X7"));
  EXPECT_EQ(3, piecesOf("G10 G90 L2 P3 X7").at(1).words.value('P'));
  EXPECT_EQ("G91 G38.2", codesOf("G38.2 G91 Z-5 F1"));
  EXPECT_EQ("G20 G92", codesOf("G92 G20 X0"));
  EXPECT_EQ("M5 G30", codesOf("G30 M5 X0"));
  EXPECT_EQ("G21 G43.1", codesOf("G43.1 G21 Z2"));
}

TEST(Pieces, StayInOrderWhenACodeHasItsCoordinates) {
  EXPECT_EQ("G28 G0", codesOf("G28 Z0 G0 X5"));
  EXPECT_EQ("G91 G28 G90", codesOf("G91 G28 Z0 G90"));
  EXPECT_EQ("G10 G0", codesOf("G10 Z0 G0 Z5"));
}

TEST(Pieces, PutACodeWithoutCoordinatesLast) {
  EXPECT_EQ("G28", codesOf("G28"));
  EXPECT_EQ("G90 G28", codesOf("G28 G90"));
  EXPECT_FALSE(piecesOf("G28 G90").at(1).words.hasPlace());
}

TEST(Mistakes, IncludeSubroutineCalls) {
  EXPECT_EQ(Fault::kNone, faultOf("O1000 (part)"));
  EXPECT_EQ(Fault::kNoCode, faultOf("O100 CALL"));
  EXPECT_EQ(Fault::kNoCode, faultOf("O100 REPEAT 5"));
  EXPECT_NE(Fault::kNone, faultOf("O<hole> CALL"));
}

TEST(Mistakes, IncludeCycleLettersWithoutANumber) {
  for (const char* line : {"G83 Q", "G81 L", "G81 K", "G43 H"})
    EXPECT_EQ(Fault::kNoNumber, faultOf(line)) << line;
}
