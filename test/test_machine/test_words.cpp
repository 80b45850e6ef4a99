// Lines are cleaned, cut into words, and numbers read whatever their form.
#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <string>

#include "machine/words.h"

using namespace machine;

namespace {

float number(const char* text, std::size_t taken) {
  const char* at = text;
  const float value = readNumber(at);
  EXPECT_EQ(std::size_t(at - text), taken) << text;
  return value;
}

std::string cleaned(const char* text) {
  char line[200];
  std::strcpy(line, text);
  clean(line);
  return line;
}

}  // namespace

TEST(Numbers, AreReadInEveryForm) {
  EXPECT_EQ(number("5", 1), 5);
  EXPECT_EQ(number("+5", 2), 5);
  EXPECT_EQ(number("-.5", 3), -0.5f);
  EXPECT_EQ(number("5.", 2), 5);
  EXPECT_FLOAT_EQ(number("1E-05", 5), 1e-5f);
  EXPECT_FLOAT_EQ(number("1.5E3", 5), 1500);
  EXPECT_FLOAT_EQ(number("63.50000000000001", 17), 63.5f);
  EXPECT_FLOAT_EQ(number("-22.3940000000000019", 20), -22.394f);
  EXPECT_FLOAT_EQ(number("123456789012345678", 18), 123456789012345678.f);
}

TEST(Numbers, ThatAreNoneTakeNothing) {
  for (const char* text : {"", "-", "+", ".", "X", "E5", "-X"}) EXPECT_EQ(number(text, 0), 0);
}

TEST(Numbers, EndBeforeAnEThatIsNoExponent) {
  EXPECT_EQ(number("5E", 1), 5);
  EXPECT_EQ(number("5EX", 1), 5);
  EXPECT_EQ(number("5E-", 1), 5);
}

TEST(Numbers, NeverLeaveTheirBoundsForAnyExponent) {
  EXPECT_EQ(number("1E-999999999", 12), 0);
  EXPECT_GT(number("1E999999999", 11), 1e30f);
}

TEST(Numbers, AreWithinTheLastDigitOfTheLibrarys) {
  std::mt19937 random(1);
  for (int i = 0; i < 20000; ++i) {
    char text[40];
    const double value = std::uniform_real_distribution<double>(-5000, 5000)(random);
    std::snprintf(text, sizeof text, "%.*f", int(random() % 16), value);
    const char* at = text;
    const float want = std::strtof(text, nullptr);
    EXPECT_NEAR(readNumber(at), want, 2.5e-7f * std::fabs(want)) << text;
    EXPECT_EQ(*at, '\0');
  }
}

TEST(Cleaning, RemovesCommentsSpacesAndSigns) {
  EXPECT_EQ(cleaned("g1 x 10 (a (b) y5 ; z"), "G1X10Y5");
  EXPECT_EQ(cleaned("G1 X5 (open"), "G1X5");
  EXPECT_EQ(cleaned("%"), "");
  EXPECT_EQ(cleaned("/G1\tX5\x7f"), "G1X5");
}

TEST(Words, KeepTheFirstOfALetterUsedTwice) {
  Words words;
  words.add('X', 1);
  words.add('X', 2);
  EXPECT_EQ(words.value('X'), 1);
  EXPECT_FALSE(words.has('Y'));
  EXPECT_EQ(words.value('Y'), 0);
}
