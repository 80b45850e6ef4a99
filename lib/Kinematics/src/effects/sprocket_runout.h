// Sprocket runout: with its bore off centre a sprocket moves to and fro as it turns.
#pragma once

#include "../effect.h"

namespace kinematics {

namespace runout {

// Sine and cosine of a quarter turn times x, |x| up to 1/2, in odd and even powers: within 0.00016.
const double kSine[2] = {1.569274915, -0.621458979};
const double kCosine[2] = {-1.23314862, 0.24649945};

const double kQuarterTurn = 1.57079632679489662;  // [rad]

}  // namespace runout

/// A sprocket whose axis is e off its middle moves the chain's start by e along the chain, to and
/// fro with each turn. Seen along the chain, the sprocket has turned by b = length / radius since
/// the chain's far end was at its tangent point: the wrap follows the chain's direction and drops
/// out. So the length is wrong by sine * sin(b) + cosine * cos(b), where sine and cosine are the
/// two parameters. The chain may leave over the top or off the bottom. At length zero a positive
/// sine has the middle below the axis, and a positive cosine at the side that rises as chain is
/// paid out.
template <class Real>
struct SprocketRunout : Effect<Real> {
  enum { kLeftSine, kLeftCosine, kRightSine, kRightCosine, kParamCount };
  enum { kQuartersByLength = kParamCount, kCoefficientCount };
  enum { kWaves = 1 };
  enum { kExampleCount = 2 };
  enum { kChainMicrometres = 8, kBitMicrometres = 12 };

  static EffectInfo info() {
    return {
        "sprocket_runout", "a sprocket's axis is off its middle, so chain comes off in waves",
        "waves of one sprocket's circumference (63.5 mm) along each chain; noise on coarse grids",
        "nothing smooth; chain_zero if all marks lie a whole turn apart",
        "turn the sprocket by half a turn under the same mark, or gauge its rim"};
  }
  static ParamInfo param(uint8_t i) {
    static const char* const kNames[] = {"left_sine", "left_cosine", "right_sine", "right_cosine"};
    const bool across = i == kLeftCosine || i == kRightCosine;
    return {kNames[i],
            "mm",
            -0.5,
            0.5,
            0.1,
            across ? "how far off its middle, at chain length 0, to the side that rises as chain "
                     "is paid out"
                   : "how far off its middle, at chain length 0, downwards",
            0};
  }
  static const char* noun() { return "sprockets off their middle"; }
  static PlainInfo plain(uint8_t i) {
    static const PlainInfo kPlain[] = {
        {"left sprocket # off its middle, high spot down",
         "left sprocket # off its middle, high spot up", "mm"},
        {"left sprocket # off its middle, high spot at the side that rises",
         "left sprocket # off its middle, high spot at the side that sinks", "mm"},
        {"right sprocket # off its middle, high spot down",
         "right sprocket # off its middle, high spot up", "mm"},
        {"right sprocket # off its middle, high spot at the side that rises",
         "right sprocket # off its middle, high spot at the side that sinks", "mm"}};
    return kPlain[i];
  }

  /// None: the phase of a runout is too easily misread from a dial gauge.
  static CheckInfo check() { return {"", "", "", 0}; }
  static Example example(uint8_t i) {
    static const Example kExamples[] = {{"both", {0, -0.1, -0.1, 0}, 1},
                                        {"left", {0, -0.1, 0, 0}, 1}};
    return kExamples[i];
  }

  /// The judge's sprocket turns about its axis: the left sprocket turns clockwise with the chain
  /// over the top.
  template <class Judge>
  static void setJudge(const Frame<Real>& frame, const Real* parameter, Judge& judge) {
    const Real turn = frame.feed == Feed::kOverTop ? Real(1) : Real(-1);
    judge.set("left.eccentric_x", -turn * parameter[kLeftCosine]);
    judge.set("left.eccentric_y", -parameter[kLeftSine]);
    judge.set("right.eccentric_x", turn * parameter[kRightCosine]);
    judge.set("right.eccentric_y", -parameter[kRightSine]);
  }

  static void prepare(const Frame<Real>& frame, const Real* parameter, Real* c) {
    for (uint8_t i = 0; i < kParamCount; ++i) c[i] = parameter[i];
    c[kQuartersByLength] = Real(1) / (frame.sprocket_radius * Real(runout::kQuarterTurn));
  }

  PLUMB_RARE static void adjustLength(const Real* c, Strand<Real, false>& strand) {
    const Real* amplitude = strand.side == kLeft ? c + kLeftSine : c + kRightSine;
    const Real quarters = strand.length * c[kQuartersByLength];
    const int16_t whole = nearest(quarters);
    const Real rest = quarters - Real(float(whole));
    const Real v = rest * rest;
    const Real sine = rest * (Real(runout::kSine[0]) + v * Real(runout::kSine[1]));
    const Real cosine = Real(1) + v * (Real(runout::kCosine[0]) + v * Real(runout::kCosine[1]));
    // A quarter turn farther the sine is the old cosine, and the cosine is the old sine with its
    // sign changed.
    const bool odd = whole & 1;
    const Real waves = odd ? amplitude[0] * cosine - amplitude[1] * sine
                           : amplitude[0] * sine + amplitude[1] * cosine;
    if (whole & 2)
      strand.length -= waves;
    else
      strand.length += waves;
  }
};

}  // namespace kinematics
