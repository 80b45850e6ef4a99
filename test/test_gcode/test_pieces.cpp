// Lines cut into commands: each row of the tables of what clients send.
#include <gtest/gtest.h>

#include "reading.h"

using namespace gcode;

TEST(Pieces, OfTheProbeLineThatClientsSendComeInOrder) {
  EXPECT_EQ("G21 G90 G38.2 G21 G90 M2", codesOf("G21 G90 G38.2 Z-10 F1 G21 G90 M02"));
  const Piece probe = piecesOf("G21 G90 G38.2 Z-10 F1 G21 G90 M02").at(2);
  EXPECT_EQ(-10, probe.words.value('Z'));
  EXPECT_EQ(1, probe.words.value('F'));
}

TEST(Pieces, OfAJogEndInItsMode) { EXPECT_EQ("G91 G0 G90", codesOf("G91 G00 X10 G90")); }

TEST(Pieces, IgnoreALinesNumber) {
  EXPECT_EQ("G1", codesOf("N10 G1 X5"));
  EXPECT_EQ("", codesOf("N10"));
}

TEST(Pieces, KeepWordsBeforeTheFirstCode) {
  EXPECT_EQ("- M3", codesOf("S12000 M3"));
  EXPECT_EQ(12000, piecesOf("S12000 M3").at(0).words.value('S'));
  EXPECT_EQ("-", codesOf("F500"));
  EXPECT_EQ("-", codesOf("X5 Y6"));
}

TEST(Pieces, HoldAToolInEitherOrder) {
  EXPECT_EQ("- M6", codesOf("T1 M6"));
  EXPECT_EQ(1, piecesOf("T1 M6").at(0).words.value('T'));
  EXPECT_EQ("M6", codesOf("M6 T1"));
  EXPECT_EQ(1, piecesOf("M6 T1").at(0).words.value('T'));
}

TEST(Pieces, NeedNoSpaces) {
  EXPECT_EQ("G1", codesOf("G1X1Y2F300"));
  EXPECT_EQ(2, valueIn("G1X1Y2F300", 'Y'));
  EXPECT_EQ("G91 G1", codesOf("G91G1X1"));
}

TEST(Pieces, KeepTenthsOfACode) { EXPECT_EQ("G91.1 G90.1 M106", codesOf("G91.1 G90.1 M106")); }

TEST(Pieces, OfLowerCaseAreTheSame) { EXPECT_EQ("G1", codesOf("g1 x5")); }

TEST(Pieces, OfAnEmptyLineAreNone) {
  for (const char* line : {"", "  ", "%", "(c)", "; c", "N5"}) EXPECT_EQ("", codesOf(line)) << line;
}

TEST(Code, ThatNobodyKnowsIsNoMistake) {
  for (const char* line : {"G54", "G92", "G28", "G64", "G80", "G94", "G17", "M7", "M8", "M999"})
    EXPECT_EQ(Fault::kNone, faultOf(line)) << line;
}

TEST(Code, ThatCannotBeIsAMistake) {
  for (const char* line : {"G-1", "G0.05 X5", "G1.04 X5", "M1000", "G1e9"})
    EXPECT_EQ(Fault::kNoCode, faultOf(line)) << line;
}

TEST(Mistake, AnywhereIsFoundBeforeAnythingRuns) {
  EXPECT_EQ(Fault::kNoNumber, faultOf("G0 X5 G1 Y6 M"));
  EXPECT_EQ('M', findMistake("G0X5G1Y6M").letter);
}

TEST(Modal, TakesUnitsAndDistancesAndNothingElse) {
  Modal modal;
  EXPECT_TRUE(modal.take(200));
  EXPECT_FLOAT_EQ(25.4f, modal.toMm(1));
  EXPECT_FLOAT_EQ(1, modal.fromMm(25.4f));
  EXPECT_TRUE(modal.take(910));
  EXPECT_FLOAT_EQ(30.4f, modal.targetOf(5, 1));
  EXPECT_TRUE(modal.take(900) && modal.take(210));
  EXPECT_FLOAT_EQ(1, modal.targetOf(5, 1));
  // The modes of arc centres are other codes.
  EXPECT_FALSE(modal.take(911) || modal.take(901) || modal.take(10));
  EXPECT_FALSE(modal.relative);
}
