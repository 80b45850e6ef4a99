// A value's text is short, has the digits that clients need, and reads back as the same value.
#include <Settings.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <random>
#include <string>

using namespace settings;

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
