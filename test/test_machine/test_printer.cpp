// Numbers as text, held against the C library, and lines as either dialect needs them.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <random>

#include "board_at_rest.h"
#include "machine/printer.h"

using namespace machine;

namespace {

struct Printed : testing::Test {
  /// What was written since the last call.
  std::string said() {
    std::string all;
    all.swap(board.said);
    return all;
  }
  std::string fixed(float number, uint8_t decimals) {
    out.fixed(number, decimals);
    return said();
  }
  std::string whole(int32_t number) {
    out << number;
    return said();
  }

  BoardAtRest board;
  Printer out{board};
};

std::string byTheLibrary(double number, int decimals) {
  char room[40];
  std::snprintf(room, sizeof room, "%.*f", decimals, number);
  return room;
}

}  // namespace

TEST_F(Printed, WholeNumbersAreThoseOfTheLibrary) {
  for (const int32_t number :
       {0, 1, 9, 10, -10, 9999, 10000, 10001, 99999999, 100000000, 100000001, 1000000000,
        -1234567890, std::numeric_limits<int32_t>::max(), std::numeric_limits<int32_t>::min()})
    EXPECT_EQ(std::to_string(number), whole(number));
}

TEST_F(Printed, DecimalsAreThoseOfTheLibrary) {
  std::mt19937 draw(1);
  std::uniform_real_distribution<float> sizes(-1.5f, 4.99f), signs(-1, 1);
  for (int i = 0; i < 20000; ++i) {
    const float number = std::copysign(std::pow(10.0f, sizes(draw)), signs(draw));
    const int decimals = i % 5;
    // As the Mega does: a product in float, rounded to a whole number.
    const float scale = std::pow(10.0f, float(decimals));
    const double rounded = double(std::lround(number * scale)) / double(scale);
    if (rounded == 0) continue;  // the library writes -0
    ASSERT_EQ(byTheLibrary(rounded, decimals), fixed(number, uint8_t(decimals))) << number;
  }
}

TEST_F(Printed, ZeroHasNoSignAndEveryDecimal) {
  EXPECT_EQ("0", fixed(0, 0));
  EXPECT_EQ("0.0000", fixed(-0.0f, 4));
  EXPECT_EQ("0.00", fixed(-0.004f, 2));
  EXPECT_EQ("-0.01", fixed(-0.006f, 2));
  EXPECT_EQ("0.0500", fixed(0.05f, 4));
}

TEST_F(Printed, OnlyTinyNumbersShowAsZero) {
  for (const float number : {100000.0f, -100000.0f, NAN, INFINITY, -INFINITY})
    EXPECT_EQ("0.00", fixed(number, 2));
  EXPECT_EQ("99999.00", fixed(99999, 2));
  EXPECT_EQ("65536.0000", fixed(65536, 4));
}
