// Words, numbers and modes: clients' lines are read as intended, and text that is not a number is
// never read as a number.
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

TEST(Modal, AcceptsTheModesThatClientsSend) {
  Modal modal;
  for (int tenths : {170, 200, 210, 400, 540, 610, 640, 800, 900, 910, 911, 940, 970, 980, 990})
    EXPECT_TRUE(modal.take(uint16_t(tenths))) << tenths;
}

TEST(Modal, LeavesMotionAndUnknownCodesAlone) {
  Modal modal;
  // Motion, what needs words, compensation, scaling, rotation, other systems, feed a turn.
  for (int tenths : {0,   10,  20,  30,  40,  100, 280, 300, 382, 410, 420, 430, 431, 490,
                     510, 520, 541, 591, 680, 730, 810, 840, 890, 920, 921, 950, 960, 1230})
    EXPECT_FALSE(modal.take(uint16_t(tenths))) << tenths;
  EXPECT_EQ(0, modal.motion);
}

TEST(Modal, EndOfProgramResetsPlaneAndOffsetsButKeepsUnits) {
  Modal modal;
  for (int tenths : {180, 200, 550, 910, 930}) modal.take(uint16_t(tenths));
  modal.motion = kPeck;
  modal.endProgram();
  EXPECT_EQ(17, modal.plane);
  EXPECT_EQ(0, modal.system);
  EXPECT_FALSE(modal.inverse_time);
  EXPECT_EQ(0, modal.motion);
  // Clients rely on units and G91 to stay.
  EXPECT_TRUE(modal.inches);
  EXPECT_TRUE(modal.relative);
  modal.motion = kNoMotion;
  modal.endProgram();
  EXPECT_EQ(0, modal.motion);
  modal.motion = 2;
  modal.endProgram();
  EXPECT_EQ(2, modal.motion);
}

TEST(WorkOffsets, FollowG10L20) {
  float stored[18] = {};
  WorkOffsets offsets(stored);
  offsets.setToolLength(-2);
  offsets.shiftTo(0, 2, 40, 0);
  EXPECT_FLOAT_EQ(40, offsets.at(0, 2));
  for (uint8_t axis = 0; axis < 3; ++axis) {
    stored[15 + axis] = offsets.storedFor(axis, 70, 12);
    EXPECT_FLOAT_EQ(70, offsets.at(5, axis) + 12) << int(axis);
  }
}

TEST(WorkOffsets, SetANewShiftAfterASuspendedOne) {
  const float stored[18] = {};
  WorkOffsets offsets(stored);
  offsets.shiftTo(0, 0, 10, 0);
  offsets.suspendShift();
  offsets.shiftTo(0, 1, 7, 0);
  EXPECT_FLOAT_EQ(7, offsets.at(0, 1));
}

namespace {

/// Angle [rad] that an arc turns about its centre, positive.
double sweep(double dx, double dy, ArcCentre centre, bool clockwise) {
  const double start = std::atan2(-double(centre.y), -double(centre.x));
  const double end = std::atan2(dy - double(centre.y), dx - double(centre.x));
  const double turned = clockwise ? start - end : end - start;
  return turned <= 0 ? turned + 2 * M_PI : turned;
}

}  // namespace

TEST(ArcCentre, IsEquidistantAndGivesTheShortArcUnlessRIsNegative) {
  std::mt19937 random(4);
  std::uniform_real_distribution<float> place(-900, 900), factor(0.501f, 20);
  for (int i = 0; i < 100000; ++i) {
    const float dx = place(random), dy = place(random);
    const float wide = factor(random) * std::hypot(dx, dy);
    const bool clockwise = i & 1, is_long = i & 2;
    const ArcCentre centre = centreByRadius(dx, dy, is_long ? -wide : wide, clockwise);
    ASSERT_TRUE(centre.found);
    const float from = std::hypot(centre.x, centre.y);
    const float to = std::hypot(centre.x - dx, centre.y - dy);
    ASSERT_NEAR(wide, from, 1e-5 * double(wide) + 1e-3);
    ASSERT_NEAR(from, to, 2e-6 * double(wide) + 1e-3);
    ASSERT_EQ(is_long, sweep(dx, dy, centre, clockwise) > M_PI);
  }
}

TEST(ArcCentre, OfAHalfCircleWithRoundedRadiusIsTheMidpoint) {
  const ArcCentre centre = centreByRadius(100, 0, 49.97f, true);
  ASSERT_TRUE(centre.found);
  EXPECT_NEAR(50, centre.x, 1e-4);
  EXPECT_TRUE(centreByRadius(2000, 0, 999.2f, true).found);
}

TEST(ArcCentre, OfAHalfCircleWithRadiusRoundedUpIsTheMidpoint) {
  EXPECT_NEAR(0, centreByRadius(100, 0, 50.001f, true).y, 1e-4);
  EXPECT_NEAR(std::sqrt(50.0015 * 50.0015 - 2500),
              -double(centreByRadius(100, 0, 50.0015f, true).y), 0.01);
  EXPECT_NEAR(0, centreByRadius(100, 0, 50.003f, true, kInchSpare).y, 1e-4);
  EXPECT_GT(-centreByRadius(100, 0, 50.0033f, true, kInchSpare).y, 0.5f);
}

TEST(ArcCentre, IsNotFoundIfTheRadiusIsTooShort) {
  EXPECT_TRUE(centreByRadius(100, 0, 49.93f, true).found);
  EXPECT_FALSE(centreByRadius(100, 0, 49.92f, true).found);
  EXPECT_FALSE(centreByRadius(100, 0, -30, false).found);
  EXPECT_FALSE(centreByRadius(100, 0, 0, false).found);
}

TEST(ArcCentre, IsNotFoundIfTheArcEndsWhereItBegins) {
  EXPECT_FALSE(centreByRadius(0, 0, 50, true).found);
}

TEST(ArcCentre, IsNotFoundForNaN) {
  EXPECT_FALSE(centreByRadius(NAN, 0, 50, true).found);
  EXPECT_FALSE(centreByRadius(1, 0, NAN, true).found);
}
