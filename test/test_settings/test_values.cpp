// Every setting has a default within its limits, only values that make sense are taken, and their
// text reads back.
#include <Settings.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "settings_flash.h"

using namespace settings;

namespace {

struct Held {
  FlashTable table;
  std::vector<float> room = std::vector<float>(kSettingCount);
  Values values{table, room.data()};
};

std::string line(const Values& values, uint8_t index) {
  std::string text;
  const auto put = [&](char c) { text += c; };
  putSetting(values, index, 0, put);
  return text;
}

std::string refusalOf(Held& held, uint8_t number, float value) {
  std::string text;
  const auto put = [&](char c) { text += c; };
  putRefusal(held.table, number, held.values.set(number, value), 0, put);
  return text;
}

float valueOf(const Held& held, uint8_t number) {
  return held.values.at(indexOf(held.table, number));
}

}  // namespace

TEST(Table, EveryDefaultMayBeSet) {
  FlashTable table;
  for (uint8_t i = 0; i < table.count(); ++i) {
    const Entry entry = table.at(i);
    EXPECT_EQ(Refusal::kNone, judge(entry, entry.usual)) << int(entry.number);
    EXPECT_EQ(Refusal::kNone, judge(entry, entry.low)) << int(entry.number);
    EXPECT_EQ(Refusal::kNone, judge(entry, entry.high)) << int(entry.number);
    EXPECT_EQ(Refusal::kOutOfRange, judge(entry, entry.high * 1.001f + 0.001f));
    EXPECT_EQ(Refusal::kNoNumber, judge(entry, NAN));
    EXPECT_EQ(Refusal::kNoNumber, judge(entry, INFINITY));
  }
}

TEST(Values, RefusedGiveAReasonAndStayTheSame) {
  Held held;
  EXPECT_EQ("$38 must be from 1 to 2, a whole number", refusalOf(held, 38, 1.5f));
  EXPECT_EQ("$38 must be from 1 to 2, a whole number", refusalOf(held, 38, 3));
  EXPECT_EQ("$2 must be from 400 to 20000", refusalOf(held, 2, -1));
  EXPECT_EQ("$69 must be from 100 to 200, in steps of 100", refusalOf(held, 69, 150));
  EXPECT_EQ("$19 must not be zero", refusalOf(held, 19, 0));
  EXPECT_EQ("$8 needs a number", refusalOf(held, 8, NAN));
  EXPECT_EQ("$14 is no setting", refusalOf(held, 14, 1));
  EXPECT_EQ("$144 is no setting", refusalOf(held, 144, 1));
  EXPECT_EQ("$43 is set by B codes only (Z limits: B17, B18, B19)", refusalOf(held, 43, 0.3f));
  EXPECT_EQ("$44 is set by B codes only (Z limits: B17, B18, B19)", refusalOf(held, 44, 1));
  for (uint8_t i = 0; i < held.table.count(); ++i)
    EXPECT_EQ(held.table.at(i).usual, held.values.at(i));
}

TEST(Values, NegativeZeroIsZero) {
  Held held;
  ASSERT_EQ(Refusal::kNone, held.values.set(37, -0.0f));
  EXPECT_FALSE(std::signbit(valueOf(held, 37)));
}

TEST(Values, WebControlsElasticityAndSledWeightMapToOurs) {
  EXPECT_EQ(170, meantBy(45));
  EXPECT_EQ(62, meantBy(46));
  for (int number = 0; number < 256; ++number) {
    const bool ours = number == 45 || number == 46;
    EXPECT_EQ(!ours, number == meantBy(uint8_t(number))) << number;
  }
}

TEST(Dump, LinesHaveNumberValueAndComment) {
  Held held;
  EXPECT_EQ("$0=2438.4 (sheet_width, mm)", line(held.values, kSheetWidth));
  EXPECT_EQ("$12=8113.73 (encoder_counts, counts/turn)", line(held.values, kEncoderCounts));
  EXPECT_EQ("$16=1 (z_motor)", line(held.values, kZMotor));
  EXPECT_EQ("$37=0 (sag_correction, 1e-12/mm^2)", line(held.values, kSagCorrection));
  EXPECT_EQ("$100=0 (effect)", line(held.values, kFirstEffectSetting));
}

TEST(Dump, CommentsHoldNothingThatAClientTakesForALine) {
  Held held;
  for (uint8_t i = 0; i < held.table.count(); ++i) {
    const std::string text = line(held.values, i);
    EXPECT_LE(text.size(), 60u) << text;
    for (char c : text) EXPECT_TRUE(c >= ' ' && c <= '~') << text;
  }
}

namespace {

std::string textOf(float value) { return formatValue(value).text; }

float fromBits(uint32_t bits) {
  float value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

/// Digits from the first that is not zero to the exponent.
int significantDigits(const std::string& text) {
  int digits = 0;
  for (char c : text.substr(0, text.find('e')))
    if (c >= '0' && c <= '9' && (digits > 0 || c != '0')) ++digits;
  return digits;
}

}  // namespace

TEST(Format, WritesNumbersAsAPersonWould) {
  EXPECT_EQ("2438.4", textOf(2438.4f));
  EXPECT_EQ("2978.4", textOf(2978.4f));
  EXPECT_EQ("8113.73", textOf(8113.73f));
  EXPECT_EQ("139.1", textOf(139.1f));
  EXPECT_EQ("0.28", textOf(0.28f));
  EXPECT_EQ("463", textOf(463));
  EXPECT_EQ("65535", textOf(65535));
  EXPECT_EQ("-3.17", textOf(-3.17f));
  EXPECT_EQ("0.00137293", textOf(0.00137293f));
  EXPECT_EQ("0.0001", textOf(0.0001f));
  EXPECT_EQ("5.2e-6", textOf(5.2e-6f));
  EXPECT_EQ("8.2e-12", textOf(8.2e-12f));
  EXPECT_EQ("100000000", textOf(1e8f));
  EXPECT_EQ("1e9", textOf(1e9f));
  EXPECT_EQ("-1.5e20", textOf(-1.5e20f));
}

TEST(Format, ZeroIsExactlyZero) {
  EXPECT_EQ("0", textOf(0.0f));
  EXPECT_EQ("0", textOf(-0.0f));
}

TEST(Format, EveryFloatReadsBackAsItself) {
  std::mt19937 random(11);
  for (int i = 0; i < 2000000; ++i) {
    const float value = fromBits(uint32_t(random()));
    if (!std::isfinite(value)) continue;
    const std::string text = textOf(value);
    ASSERT_LT(text.size(), sizeof(ValueText)) << text;
    ASSERT_EQ(value, std::strtof(text.c_str(), nullptr)) << text;
    // Numbers below 1.2e-38 have fewer binary digits to begin with.
    const double ratio = std::strtod(text.c_str(), nullptr) / double(value);
    ASSERT_NEAR(1, ratio, std::fabs(value) >= 1.2e-38f ? 1e-7 : 1) << text;
    ASSERT_LE(significantDigits(text), 9) << text;
  }
}

TEST(Format, WritesNoMoreDigitsThanNeeded) {
  // Against the printf of the host: never more digits than the shortest of 7 to 9 that reads back.
  std::mt19937 random(12);
  std::uniform_real_distribution<double> exponent(-14, 6);
  int longer = 0;
  for (int i = 0; i < 100000; ++i) {
    const float value = float(std::pow(10.0, exponent(random)));
    int needed = 7;
    char text[40];
    for (; needed < 9; ++needed) {
      std::snprintf(text, sizeof text, "%.*g", needed, double(value));
      if (std::strtof(text, nullptr) == value) break;
    }
    if (significantDigits(textOf(value)) > needed) ++longer;
  }
  // If rounding decides, an additional digit is written.
  EXPECT_LT(longer, 3000);
}
