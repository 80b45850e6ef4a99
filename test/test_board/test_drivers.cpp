// Every shield's wiring, every driver's levels; encoder edges become counts in the right direction.
#include <gtest/gtest.h>

#include <set>

#include "board/drivers.h"
#include "board/quadrature.h"

using namespace board;

namespace {

const Shield& shieldOf(uint8_t straps) {
  for (const Shield& shield : kShields)
    if (shield.straps == straps) return shield;
  throw std::runtime_error("no such shield");
}

void expectLevels(const Levels& levels, int input1, int input2, int enable) {
  EXPECT_EQ(levels.input1, input1);
  EXPECT_EQ(levels.input2, input2);
  EXPECT_EQ(levels.enable, enable);
}

Channel over(uint8_t straps, Motor motor) { return channelOf(shieldOf(straps), motor, true); }
Channel below(uint8_t straps, Motor motor) { return channelOf(shieldOf(straps), motor, false); }

void expectPins(const Channel& channel, int input1, int input2, int enable) {
  EXPECT_EQ(channel.input1, input1);
  EXPECT_EQ(channel.input2, input2);
  EXPECT_EQ(channel.enable, enable);
}

}  // namespace

TEST(Wiring, CrossesTheLeftMotorOverTheTop) {
  expectPins(over(61, Motor::kLeft), 13, 12, 5);
  expectPins(over(62, Motor::kLeft), 11, 10, 12);
  expectPins(over(63, Motor::kLeft), 12, 11, 10);
  expectPins(over(52, Motor::kLeft), 11, 10, 12);
  expectPins(over(4, Motor::kLeft), 11, 10, 12);
  expectPins(over(6, Motor::kLeft), 5, 6, kNoPin);
  expectPins(over(8, Motor::kLeft), 9, 10, kNoPin);
  expectPins(below(63, Motor::kLeft), 11, 12, 10);
}

TEST(Wiring, CrossesTheRightMotorBelow) {
  expectPins(over(61, Motor::kRight), 9, 8, 6);
  expectPins(over(62, Motor::kRight), 6, 4, 5);
  expectPins(over(63, Motor::kRight), 4, 6, 5);
  expectPins(over(52, Motor::kRight), 6, 4, 5);
  expectPins(over(6, Motor::kRight), 9, 10, kNoPin);
  expectPins(over(8, Motor::kRight), 6, 5, kNoPin);
  expectPins(below(61, Motor::kRight), 8, 9, 6);
}

TEST(Wiring, NeverCrossesZ) {
  for (const Shield& shield : kShields)
    for (const bool over_top : {true, false}) {
      const Channel channel = channelOf(shield, Motor::kZ, over_top);
      expectPins(channel, shield.z.first, shield.z.second, shield.z.enable);
    }
}

TEST(Wiring, TurnsATle9201RoundByItsDirectionPin) {
  for (const bool over_top : {true, false})
    for (const Motor motor : {Motor::kLeft, Motor::kRight, Motor::kZ}) {
      const Channel channel = channelOf(shieldOf(7), motor, over_top);
      EXPECT_EQ(channel.input1, pinsOf(shieldOf(7), motor).first);
      EXPECT_EQ(channel.forward_is_high, over_top && motor != Motor::kZ);
    }
}

TEST(Shields, HaveDistinctStrapsAndUseNoPinTwice) {
  std::set<uint8_t> straps;
  for (const Shield& shield : kShields) {
    EXPECT_TRUE(straps.insert(shield.straps).second) << "v1." << int(shield.version);
    std::set<uint8_t> pins;
    const auto take = [&](uint8_t pin) {
      EXPECT_TRUE(pin == kNoPin || pins.insert(pin).second)
          << "v1." << int(shield.version) << ": pin " << int(pin) << " is used twice";
    };
    for (const MotorPins& motor : {shield.right, shield.z, shield.left})
      for (uint8_t pin :
           {motor.encoder_a, motor.encoder_b, motor.first, motor.second, motor.enable})
        take(pin);
    take(shield.spindle);
    take(shield.laser);
    take(shield.probe);
  }
}

TEST(Drivers, PulseTheEnableOfAnL298) {
  const Channel channel = over(63, Motor::kRight);
  expectLevels(levelsFor(channel, 100), 255, 0, 100);
  expectLevels(levelsFor(channel, -100), 0, 255, 100);
  expectLevels(levelsFor(channel, 0), 255, 0, 0);
  expectLevels(levelsOff(channel), 255, 0, 0);
}

TEST(Drivers, PulseAnInputWhereTheEnableOfAnL298HasNoPwm) {
  // v1.1: the left enable is pin 12. Over the top input 2 is pin 10, which can pulse.
  const Channel top = over(62, Motor::kLeft);
  expectLevels(levelsFor(top, 100), 255, 155, 255);
  expectLevels(levelsFor(top, -100), 0, 100, 255);
  expectLevels(levelsOff(top), 255, 0, 0);
  const Channel bottom = below(62, Motor::kLeft);
  expectLevels(levelsFor(bottom, 100), 100, 0, 255);
  expectLevels(levelsFor(bottom, -100), 155, 255, 255);
}

TEST(Drivers, PulseOneInputOfATle5206AndBrakeWithBothLow) {
  const Channel right = over(52, Motor::kRight);  // pin 6 pulses, pin 4 does not
  expectLevels(levelsFor(right, 100), 100, 0, 0);
  expectLevels(levelsFor(right, -100), 155, 255, 0);
  expectLevels(levelsFor(right, 0), 0, 0, 0);
  expectLevels(levelsOff(right), 0, 0, 0);
  const Channel z = over(52, Motor::kZ);  // both pulse
  expectLevels(levelsFor(z, 100), 255, 155, 0);
  expectLevels(levelsFor(z, -100), 155, 255, 0);
  EXPECT_FALSE(hasEnable(z));
}

TEST(Drivers, ReportErrorsOnlyOnATle5206) {
  for (const Shield& shield : kShields) {
    const bool speaks = shield.driver == Driver::kTle5206;
    EXPECT_EQ(speaks ? 12 : kNoPin, errorPinOf(shield, Motor::kLeft)) << int(shield.version);
    EXPECT_EQ(speaks ? 5 : kNoPin, errorPinOf(shield, Motor::kRight));
    EXPECT_EQ(speaks ? 8 : kNoPin, errorPinOf(shield, Motor::kZ));
  }
}

TEST(Drivers, PulseOneInputOfATb6643AndBrakeWithBothHigh) {
  for (const uint8_t straps : {6, 8}) {
    const Channel channel = over(straps, Motor::kLeft);
    expectLevels(levelsFor(channel, 100), 100, 0, 0);
    expectLevels(levelsFor(channel, -100), 0, 100, 0);
    expectLevels(levelsFor(channel, 0), 255, 255, 0);
    expectLevels(levelsOff(channel), 0, 0, 0);
    EXPECT_FALSE(hasEnable(channel));
  }
}

TEST(Drivers, GiveATle9201DirectionDisableAndPwm) {
  const Channel left = over(7, Motor::kLeft), z = over(7, Motor::kZ);
  expectLevels(levelsFor(left, 100), 255, 0, 100);
  expectLevels(levelsFor(left, -100), 0, 0, 100);
  expectLevels(levelsFor(z, 100), 0, 0, 100);
  expectLevels(levelsFor(left, 0), 255, 0, 0);
  expectLevels(levelsOff(left), 0, 255, 0);
}

TEST(Drivers, ShortAMotorToBrakeIt) {
  for (const uint8_t straps : {61, 62, 63})
    for (const Motor motor : {Motor::kLeft, Motor::kRight, Motor::kZ})
      expectLevels(levelsToBrake(over(straps, motor)), 0, 0, 255);
  expectLevels(levelsToBrake(over(52, Motor::kLeft)), 0, 0, 0);
  for (const uint8_t straps : {6, 8})
    expectLevels(levelsToBrake(over(straps, Motor::kLeft)), 255, 255, 0);
  expectLevels(levelsToBrake(over(7, Motor::kLeft)), 0, 0, 0);
}

TEST(Drivers, PulseOnlyPinsThatHavePwm) {
  for (const Shield& shield : kShields)
    for (const Motor motor : {Motor::kLeft, Motor::kRight, Motor::kZ})
      for (const bool over_top : {true, false}) {
        const Channel channel = channelOf(shield, motor, over_top);
        for (int drive = -300; drive <= 300; ++drive) {
          const Levels shown = levelsFor(channel, int16_t(drive));
          const auto pulses = [](uint8_t level) { return level != kLow && level != kHigh; };
          EXPECT_TRUE(!pulses(shown.input1) || canPulse(channel.input1));
          EXPECT_TRUE(!pulses(shown.input2) || canPulse(channel.input2));
          EXPECT_TRUE(!pulses(shown.enable) || canPulse(channel.enable));
        }
      }
}

TEST(Drivers, GetAPwmFrequencyThatTheChipCanFollow) {
  for (const uint8_t wanted : {0, 1, 2, 3, 9}) EXPECT_EQ(pwmFor(Driver::kTle5206, wanted), 3);
  EXPECT_EQ(pwmFor(Driver::kTle9201, 1), 2);
  EXPECT_EQ(pwmFor(Driver::kL298, 1), 1);
  EXPECT_EQ(pwmFor(Driver::kTb6643, 2), 2);
  EXPECT_EQ(pwmFor(Driver::kL298, 0), 3);
  EXPECT_EQ(dividerBitsOfTimer2(3), 4);
}

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
