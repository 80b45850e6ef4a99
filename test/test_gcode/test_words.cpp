// Words and numbers: clients' lines are read as intended, and text that is not a number is never
// read as a number.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>

#include "reading.h"

using namespace gcode;

namespace {

/// How many floats lie between two.
long apart(float a, float b) {
  const float spacing = std::nextafter(std::fabs(b), INFINITY) - std::fabs(b);
  return std::lround(std::fabs(double(a) - double(b)) / double(spacing));
}

/// A decimal number as a program may print it.
std::string decimal(std::mt19937& random) {
  const int places = int(random() % 17), whole = int(random() % 5);
  std::string text = random() % 2 ? "-" : random() % 4 ? "" : "+";
  for (int i = 0; i < whole; ++i) text += char('0' + random() % 10);
  if (whole == 0 && places == 0) text += '7';
  if (places != 0) text += '.';
  for (int i = 0; i < places; ++i) text += char('0' + random() % 10);
  return text;
}

}  // namespace

TEST(Number, IsTheNearestFloatOrItsNeighbourForAnyDecimals) {
  std::mt19937 random(1);
  for (int i = 0; i < 300000; ++i) {
    const std::string text = decimal(random);
    const char* at = text.c_str();
    const Number number = readNumber(at);
    ASSERT_EQ(Fault::kNone, number.fault) << text;
    ASSERT_EQ('\0', *at) << text;
    ASSERT_LE(apart(number.value, std::strtof(text.c_str(), nullptr)), 1) << text;
  }
}

TEST(Number, WithSeventeenDigitsIsTheNearestFloatOrItsNeighbour) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> exponent(-2, 5);
  for (int i = 0; i < 300000; ++i) {
    char text[40];
    std::snprintf(text, sizeof text, "%.17G",
                  (random() % 2 ? 1 : -1) * std::pow(10, exponent(random)));
    const char* at = text;
    ASSERT_LE(apart(readNumber(at).value, std::strtof(text, nullptr)), 1) << text;
  }
}

TEST(Number, OfAnySizeIsWithinThreeUnitsInTheLastPlace) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> exponent(-30, 30);
  for (int i = 0; i < 300000; ++i) {
    char text[40];
    std::snprintf(text, sizeof text, "%.*E", int(random() % 17), std::pow(10, exponent(random)));
    const char* at = text;
    ASSERT_LE(apart(readNumber(at).value, std::strtof(text, nullptr)), 3) << text;
  }
}

TEST(Number, MayHaveAnyNumberOfDigits) {
  EXPECT_FLOAT_EQ(-22.394f, valueIn("G1 X-22.3940000000000019", 'X'));
  EXPECT_FLOAT_EQ(63.5f, valueIn("X63.50000000000001", 'X'));
  EXPECT_FLOAT_EQ(1, valueIn("X" + std::string(60, '0') + "1", 'X'));
  EXPECT_FLOAT_EQ(1e20f, valueIn("X1" + std::string(20, '0'), 'X'));
}

TEST(Number, IsReadAfterASpace) { EXPECT_EQ(10, valueIn("G1 X 10", 'X')); }

TEST(Number, MayHaveAnExponent) {
  EXPECT_FLOAT_EQ(1e-5f, valueIn("X1E-05", 'X'));
  EXPECT_FLOAT_EQ(-2.5e-7f, valueIn("x-2.5e-07", 'X'));
  EXPECT_FLOAT_EQ(1e5f, valueIn("X1E+5", 'X'));
}

TEST(Number, MayHaveAPlusOrBeginOrEndWithAPoint) {
  EXPECT_EQ(5, valueIn("X+5", 'X'));
  EXPECT_EQ(0.5f, valueIn("X.5", 'X'));
  EXPECT_EQ(5, valueIn("X5.", 'X'));
  EXPECT_EQ(-0.5f, valueIn("X-.5", 'X'));
}

class NoNumber : public testing::TestWithParam<const char*> {};
TEST_P(NoNumber, IsAMistake) { EXPECT_EQ(Fault::kBadNumber, faultOf(GetParam())); }
INSTANTIATE_TEST_SUITE_P(Malformed, NoNumber,
                         testing::Values("X--5", "X1.2.3", "X1-2", "X+-1", "X-", "X.", "X1E",
                                         "X1E-", "X1..2", "X5 6", "X1 .5", "X1(c)2", "X1/2", "X1%2",
                                         "Q1.2.3", "G1 X5 X--6", "G1.2.3 X5"));

TEST(Word, OfAKnownLetterNeedsItsNumber) {
  for (const char* line : {"G1 X", "G X5", "G1 X Y5", "M", "T M6", "G1 XNAN", "XINF", "F", "G4 P"})
    EXPECT_EQ(Fault::kNoNumber, faultOf(line)) << line;
}

TEST(Word, BeyondAFloatIsAMistake) {
  EXPECT_EQ(Fault::kTooLarge, faultOf("X1e99"));
  EXPECT_EQ(Fault::kTooLarge, faultOf("X-1E400"));
  EXPECT_EQ(Fault::kTooLarge, faultOf("X9" + std::string(60, '9')));
  EXPECT_EQ(Fault::kTooLarge, faultOf("X999999999E30"));
  EXPECT_EQ(Fault::kNone, faultOf("X340000000E30"));
  EXPECT_EQ(Fault::kNone, faultOf("X1e-99"));
}

TEST(Word, BeginsWithALetter) {
  for (const char* line : {"5 G1 X5", "G1 X5 =3", "G1 X5)", "\"", "G1 X5 ? Y5"})
    EXPECT_EQ(Fault::kStray, faultOf(line)) << line;
}

TEST(Word, OfAnUnknownLetterIsIgnoredWithOrWithoutNumber) {
  EXPECT_EQ(Fault::kNone, faultOf("G1 X5 Q3 W"));
  EXPECT_EQ(5, valueIn("G1 Q3 W X5", 'X'));
}

TEST(Word, AfterASpaceIsNotAnExponent) { EXPECT_EQ(10, valueIn("G1 X10 E5", 'X')); }

TEST(Word, IsTheFirstOfTwoWithTheSameLetter) { EXPECT_EQ(5, valueIn("G1 X5 X6", 'X')); }

TEST(Word, MayBeALetterAloneInABCode) {
  EXPECT_EQ(Fault::kNone, findMistake("L", "LR").fault);
  EXPECT_EQ(Fault::kNone, findMistake("S255T3L", "LR").fault);
  EXPECT_EQ(Fault::kNoNumber, findMistake("LR", "").fault);
  EXPECT_EQ('L', findMistake("L", "").letter);
  EXPECT_EQ(Fault::kBadNumber, findMistake("L--1", "LR").fault);
}

TEST(Clean, RemovesCommentsOfBothKinds) {
  EXPECT_EQ("G1X5Y6", cleaned("G1 (go (there) X5 Y6 ; X7"));
  EXPECT_EQ("G1", cleaned("G1 (never closed X5"));
  EXPECT_EQ("", cleaned("; only a comment"));
}

TEST(Clean, RemovesSpacesPercentAndSlashAndMakesLettersCapital) {
  EXPECT_EQ("G1X5", cleaned(" %/ g1 x5 % "));
  EXPECT_EQ("", cleaned("   "));
}

TEST(Clean, KeepsTheSpaceAfterALetterWithoutANumber) {
  EXPECT_EQ("G1X Y5", cleaned("G1 X  (c) Y5"));
  EXPECT_EQ("G1X-Y5", cleaned("G1 X - Y5"));
  EXPECT_EQ(Fault::kNoNumber, faultOf("G1 X Y5"));
}

TEST(Clean, RemovesACorrectChecksum) {
  EXPECT_EQ("N1G21", cleaned("N1 G21*27"));
  EXPECT_EQ("N1G21", cleaned("N1 G21*27 "));
  EXPECT_EQ("N1G21*28", cleaned("N1 G21*28"));
  EXPECT_EQ("N1G21*283", cleaned("N1 G21*283")) << "27 and 256 more";
  EXPECT_EQ("N1G21*65563", cleaned("N1 G21*65563"));
  EXPECT_EQ("N1G21*2 7", cleaned("N1 G21*2 7"));
  EXPECT_EQ("N1G21*", cleaned("N1 G21*"));
  EXPECT_EQ("*", cleaned("*"));
  EXPECT_EQ("X5", cleaned("(2*3; no end) X5 ; *"));
}

TEST(Clean, NeverJoinsTwoNumbers) {
  EXPECT_EQ("X1 2", cleaned("X1 (c) 2"));
  EXPECT_EQ("X10 E5", cleaned("X10 E5"));
}
