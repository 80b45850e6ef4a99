// Encoder edges become counts, on every shield in the right direction.
#include <gtest/gtest.h>

#include "board/quadrature.h"

using namespace board;

namespace {

const uint8_t kRising[] = {0, 2, 3, 1};

/// The pins of the low and of the high bit of each pair.
const int kLowPin[] = {21, 19, 2}, kHighPin[] = {20, 18, 3};

/// How a motor's count changes by a step in which its second channel leads.
int countWhenSecondLeads(const Shield& shield, Motor motor, bool over_top) {
  const MotorPins& pins = pinsOf(shield, motor);
  const bool cross = motor == Motor::kZ || isCrossed(motor, over_top);
  const int second = cross ? pins.encoder_a : pins.encoder_b;
  const EncoderWiring wiring = encoderOf(shield, motor, over_top);
  Quadrature quadrature = {0, 0, 0};
  quadrature.turn(second == kHighPin[wiring.pair] ? 2 : 1);
  const int count = int16_t(quadrature.count);
  return wiring.reversed ? -count : count;
}

}  // namespace

TEST(Quadrature, CountsFourEdgesATurnOfItsChannels) {
  Quadrature quadrature = {0, 0, 0};
  for (int i = 1; i <= 4000; ++i) quadrature.turn(kRising[i % 4]);
  EXPECT_EQ(quadrature.count, 4000);
  for (int i = 3999; i >= 0; --i) quadrature.turn(kRising[i % 4]);
  EXPECT_EQ(quadrature.count, 0);
}

TEST(Quadrature, WrapsRoundBelowZero) {
  Quadrature quadrature = {0, 0, 0};
  quadrature.turn(1);
  EXPECT_EQ(int16_t(quadrature.count), -1);
}

TEST(Quadrature, CountsNothingWhenBothChannelsChangeOrNone) {
  for (uint8_t state = 0; state < 4; ++state) {
    Quadrature quadrature = {state, 7, 0};
    quadrature.turn(state);
    quadrature.turn(state ^ 3);
    EXPECT_EQ(quadrature.count, 7);
  }
}

TEST(Quadrature, CountsIllegalSteps) {
  Quadrature quadrature = {0, 0, 0};
  for (int i = 1; i <= 400; ++i) quadrature.turn(kRising[i % 4]);
  EXPECT_EQ(quadrature.illegal, 0) << "one channel after the other";
  for (uint8_t state = 0; state < 4; ++state) {
    quadrature.state = state;
    quadrature.turn(state);
    EXPECT_EQ(quadrature.illegal, state) << "nothing changed";
    quadrature.turn(state ^ 3);
    EXPECT_EQ(quadrature.illegal, state + 1) << "both changed";
  }
}

TEST(Encoders, CountUpOnEveryShieldWhenTheSecondChannelLeads) {
  for (const Shield& shield : kShields)
    for (const Motor motor : {Motor::kLeft, Motor::kRight, Motor::kZ})
      for (const bool over_top : {true, false})
        EXPECT_EQ(countWhenSecondLeads(shield, motor, over_top), 1)
            << "v1." << int(shield.version) << " motor " << int(motor) << " top " << over_top;
}

TEST(Encoders, AreOnPairsWithInterrupts) {
  for (const Shield& shield : kShields)
    for (const Motor motor : {Motor::kLeft, Motor::kRight, Motor::kZ}) {
      const MotorPins& pins = pinsOf(shield, motor);
      const uint8_t pair = encoderOf(shield, motor, true).pair;
      const int low = kLowPin[pair], high = kHighPin[pair];
      EXPECT_TRUE((pins.encoder_a == low && pins.encoder_b == high) ||
                  (pins.encoder_a == high && pins.encoder_b == low));
    }
}
