// Every setting has a default within its limits, and only values that make sense are taken.
#include <gtest/gtest.h>

#include <cmath>
#include <set>
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

TEST(Table, NumbersRiseAndAvoidReservedOnes) {
  FlashTable table;
  int before = -1;
  for (uint8_t i = 0; i < table.count(); ++i) {
    const int number = table.at(i).number;
    EXPECT_GT(number, before);
    EXPECT_TRUE(number <= 44 || (number >= 60 && number <= 84) || number == 99 || number >= 100);
    EXPECT_NE(144, number);
    EXPECT_NE(14, number);
    before = number;
  }
}

TEST(Table, ListsEveryPublishedNumberAndNoneThatWebControlWouldAnswer) {
  FlashTable table;
  std::set<int> listed;
  for (uint8_t i = 0; i < table.count(); ++i)
    if (table.at(i).access == Access::kListed) listed.insert(table.at(i).number);
  for (int number = 0; number <= 42; ++number) EXPECT_EQ(number != 14, listed.count(number) == 1);
  // 60 and 61 have the same meaning in the published beta.
  for (int number = 43; number <= 59; ++number) EXPECT_FALSE(listed.count(number)) << number;
  for (int number = 85; number <= 99; ++number) EXPECT_FALSE(listed.count(number)) << number;
}

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

TEST(Table, HoldsEveryEffectParameterWithDefaultAbsent) {
  FlashTable table;
  int found = 0;
  for (int number = 100; number < kFirstPlaceNumber; ++number) {
    const int place = kinematics::Effects::For<float>::indexOf(number);
    const uint8_t index = indexOf(table, uint8_t(number));
    ASSERT_EQ(place >= 0, index != kNoIndex) << number;
    if (place < 0) continue;
    ++found;
    EXPECT_EQ(kFirstEffectSetting + place, index);
    EXPECT_EQ(0, table.at(index).usual);
    EXPECT_LT(table.at(index).low, 0);
    EXPECT_GT(table.at(index).high, 0);
  }
  EXPECT_EQ(int(kinematics::kEffectParamCount), found);
}

TEST(Table, EffectLimitsAreTheirPlausibleRangeWidened) {
  FlashTable table;
  const Entry pitch = table.at(indexOf(table, 180));
  EXPECT_FLOAT_EQ(-0.008f, pitch.low);
  EXPECT_FLOAT_EQ(0.013f, pitch.high);
  // For both signs: 30 mm each way, widened by the width of the range.
  for (const uint8_t number : {200, 201}) {
    const Entry zero = table.at(indexOf(table, number));
    EXPECT_FLOAT_EQ(-90, zero.low) << int(number);
    EXPECT_FLOAT_EQ(90, zero.high) << int(number);
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
