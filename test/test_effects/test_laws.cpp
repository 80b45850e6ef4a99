// The laws every registered effect obeys: zero means absent, zero has a slope, sizes are sane.
#include <Kinematics.h>
#include <gtest/gtest.h>
#include <math.h>
#include <string.h>

#include <algorithm>
#include <string>
#include <vector>

#include "hidden.h"

using namespace kinematics;

namespace {

/// A parameter of the registry: its index, its number and its description.
struct AnyParam {
  std::string effect;
  int index;    // in EffectParams
  int setting;  // its $-number
  ParamInfo info;
};

void PrintTo(const AnyParam& any, std::ostream* out) { *out << any.effect << "." << any.info.name; }

struct Collect {
  std::vector<AnyParam> all;
  std::vector<EffectInfo> effects;

  template <class ThisEffect>
  void effect(int first_setting) {
    effects.push_back(ThisEffect::info());
    for (uint8_t i = 0; i < ThisEffect::kParamCount; ++i)
      all.push_back(
          {ThisEffect::info().name, int(all.size()), first_setting + i, ThisEffect::param(i)});
  }
};

Collect collect() {
  Collect collected;
  Effects::For<double>::visit(collected);
  return collected;
}

std::vector<AnyParam> everyParam() { return collect().all; }

template <class Real>
Machine<Real> machineWith(const EffectParams<Real>& effects, Feed feed = Feed::kOverTop) {
  const Frame<Real> frame = {Real(2978.4),  Real(1072.6), Real(0),          Real(139.1),
                             Real(10.1063), Real(97.9),   Real(0.00137293), feed};
  return prepare(frame, effects);
}

template <class Real>
std::vector<Point<Real>> places() {
  std::vector<Point<Real>> all;
  for (int x = -1200; x <= 1200; x += 200)
    for (int y = -600; y <= 600; y += 200) all.push_back({Real(x), Real(y)});
  return all;
}

/// Sum over places and sides of |length with a parameter at `size` - length without it|; another
/// parameter may be given a size as well. All else is a chain that sags and stretches: a chain that
/// does neither does not feel a force.
double effectOf(const AnyParam& any, double size, int other, double other_size) {
  EffectParams<double> without = usualChain();
  without.value[any.index] = without.value[other] = 0;
  EffectParams<double> with = without;
  with.value[other] = other_size;
  with.value[any.index] = size;
  const Machine<double> bare = machineWith(without), changed = machineWith(with);
  double sum = 0;
  for (const Point<double>& place : places<double>()) {
    const Chains<double> a = inverse(bare, place).chains, b = inverse(changed, place).chains;
    sum += fabs(a.left - b.left) + fabs(a.right - b.right);
  }
  return sum;
}

double effectOf(const AnyParam& any, double size) { return effectOf(any, size, any.index, size); }

}  // namespace

class EveryParam : public testing::TestWithParam<AnyParam> {};
INSTANTIATE_TEST_SUITE_P(Registry, EveryParam, testing::ValuesIn(everyParam()),
                         [](const testing::TestParamInfo<AnyParam>& tested) {
                           return tested.param.effect + "_" + tested.param.info.name;
                         });

TEST_P(EveryParam, HasANonZeroSlopeAtZero) {
  // The slope at zero must not vanish: half a size has about half the effect, not a quarter.
  const double small = 1e-3 * GetParam().info.typical;
  const double whole = effectOf(GetParam(), small), half = effectOf(GetParam(), small / 2);
  ASSERT_GT(whole, 0);
  EXPECT_NEAR(0.5, half / whole, 0.02);
}

TEST_P(EveryParam, TypicalSizeMovesChainsNoticeablyButPlausibly) {
  const double mean =
      effectOf(GetParam(), GetParam().info.typical) / (2.0 * double(places<double>().size()));
  EXPECT_GT(mean, 0.005) << "mm of chain";
  EXPECT_LT(mean, 50) << "mm of chain";
}

TEST_P(EveryParam, HasALikelyRangeASummaryAndASetting) {
  const ParamInfo& info = GetParam().info;
  EXPECT_LT(info.low, info.high);
  EXPECT_LE(info.low, info.typical);
  EXPECT_GE(info.high, info.typical);
  EXPECT_LE(info.low, 0) << "absence must be plausible";
  EXPECT_GT(strlen(info.summary), 10u);
  EXPECT_GE(GetParam().setting, 100);
  EXPECT_LE(GetParam().setting, 255);
}

TEST(Registry, EffectsAtZeroAreBitForBitAbsent) {
  // Working out the forces must change nothing either.
  const EffectParams<float> none = {};
  Machine<float> without = machineWith(none);
  Machine<float> asked = without;
  asked.forces = true;
  asked.present = uint16_t((1u << Effects::kEffectCount) - 1);
  for (const Point<float>& place : places<float>()) {
    const Chains<float> a = inverse(without, place).chains, b = inverse(asked, place).chains;
    EXPECT_EQ(0, memcmp(&a, &b, sizeof a)) << place.x << " " << place.y;
  }
}

TEST(Registry, EffectsAddUpWithoutDisturbingEachOther) {
  // Two effects together differ from the sum of both by far less than the size of either.
  for (const AnyParam& first : everyParam())
    for (const AnyParam& other : everyParam()) {
      if (first.effect == other.effect) continue;
      const double alone =
          effectOf(first, first.info.typical) + effectOf(other, other.info.typical);
      EXPECT_LT(effectOf(first, first.info.typical, other.index, other.info.typical), 1.1 * alone);
    }
}

namespace {

/// Counts the numbers that an effect sets on the judge.
struct CountSaid {
  int sets = 0;
  void set(const char*, double) { ++sets; }
  void scale(const char*, double) { ++sets; }
};

/// What is missing in each effect's header, with what to write there.
struct Missing {
  std::vector<std::string> lines;

  template <class ThisEffect>
  void effect(int) {
    const std::string header = std::string("effects/") + ThisEffect::info().name + ".h: ";
    if (!ThisEffect::check().title)
      lines.push_back(header +
                      "say how an owner measures it: static CheckInfo check(), with an "
                      "empty title if nobody can");
    bool checked = false;
    for (uint8_t i = 0; i < ThisEffect::kParamCount; ++i) checked |= ThisEffect::param(i).sigma > 0;
    if (ThisEffect::check().title && checked != (ThisEffect::check().title[0] != 0))
      lines.push_back(header + "a check() needs the sigma of a param(), and a sigma a check()");
    for (uint8_t i = 0; i < ThisEffect::kParamCount; ++i)
      if ((ThisEffect::param(i).sigma > 0) != (*ThisEffect::reading(i).title != 0))
        lines.push_back(header + "a sigma needs a reading(), and a reading() a sigma");
    if (ThisEffect::kEmpirical == 1) return;
    for (uint8_t i = 0; i < ThisEffect::kExampleCount; ++i)
      if (!ThisEffect::example(i).label)
        lines.push_back(header +
                        "give the bench a machine that suffers from it: static Example "
                        "example(uint8_t i), kExampleCount of them");
    if (ThisEffect::kExampleCount == 0)
      lines.push_back(header + "the bench needs at least one example()");
    std::vector<double> typical;
    for (uint8_t i = 0; i < ThisEffect::kParamCount; ++i)
      typical.push_back(ThisEffect::param(i).typical);
    CountSaid said;
    ThisEffect::setJudge(Frame<double>(), typical.data(), said);
    if (!said.sets)
      lines.push_back(header +
                      "say it in the judge's numbers: setJudge(); what he lacks is added "
                      "in tools/judge/reference");
  }
};

}  // namespace

TEST(Registry, ClearsOnlySagAndStretch) {
  EffectParams<double> effects;
  for (double& value : effects.value) value = 1;
  Effects::For<double>::clearBends(effects.value);
  for (const AnyParam& any : everyParam()) {
    const bool bends = any.effect == "chain_sag" || any.effect == "chain_stretch";
    EXPECT_EQ(bends ? 0 : 1, effects.value[any.index]) << any.effect;
  }
}

TEST(Registry, AddsUpRunoutOfBothSprockets) {
  EffectParams<double> effects = {};
  for (const AnyParam& any : everyParam())
    effects.value[any.index] = any.effect == "sprocket_runout" ? -0.25 : 3;
  EXPECT_DOUBLE_EQ(1, Effects::For<double>::wavesOf(effects.value));
}

TEST(Registry, FindsTheFirstParameterOfAnEffect) {
  typedef Effects::For<double> All;
  EXPECT_EQ(All::indexOf(100), All::firstOf<MotorLevel<double>>());
  EXPECT_EQ(All::indexOf(180), All::firstOf<ChainPitch<double>>());
}

TEST(Registry, EveryHeaderHasAllTextsForTheLab) {
  Missing missing;
  Effects::For<double>::visit(missing);
  for (const std::string& line : missing.lines) ADD_FAILURE() << line;
}

TEST(Registry, PublishedNumbersKeepTheirMeaning) {
  // These numbers are in the EEPROMs of owners: a change here would change their machines.
  std::vector<std::string> numbers;
  for (const AnyParam& any : everyParam())
    numbers.push_back(std::to_string(any.setting) + " " + any.effect + "." + any.info.name);
  const std::vector<std::string> released = {"100 motor_level.height_difference",
                                             "110 frame_flex.inward",
                                             "111 frame_flex.downward",
                                             "120 sled_swing.right",
                                             "121 sled_swing.up",
                                             "130 chain_plane.gap_squared",
                                             "150 frame_lean.tangent_squared",
                                             "160 chain_sag.weight_ratio_squared",
                                             "170 chain_stretch.compliance",
                                             "180 chain_pitch.left",
                                             "181 chain_pitch.right",
                                             "190 sprocket_runout.left_sine",
                                             "191 sprocket_runout.left_cosine",
                                             "192 sprocket_runout.right_sine",
                                             "193 sprocket_runout.right_cosine",
                                             "200 chain_zero.left",
                                             "201 chain_zero.right",
                                             "210 residual_patch.left_x",
                                             "219 residual_patch.right_x",
                                             "227 residual_patch.right_yyy"};
  for (const std::string& number : released)
    EXPECT_NE(numbers.end(), std::find(numbers.begin(), numbers.end(), number)) << number;
}

/// Leaves what is no number on the stack, where the next function has its variables.
__attribute__((noinline)) void litterTheStack() {
  volatile double litter[4096];
  for (volatile double& each : litter) each = NAN;
}

// A chain that neither sags nor stretches asks for no direction.
TEST(EffectAlone, ReadsNothingThatNobodyWorkedOut) {
  for (const AnyParam& any : everyParam()) {
    EffectParams<double> alone = {};
    alone.value[any.index] = any.info.typical;
    const Machine<double> machine = machineWith(alone);
    for (const Point<double>& place : places<double>()) {
      const Hanging<double> drawn = hang(machine, place, true);
      litterTheStack();
      const PaidOut<double> paid = inverse(machine, place);
      ASSERT_EQ(drawn.found, paid.found) << any.effect << "." << any.info.name;
      if (paid.found != Found::kYes) continue;
      const Strand<double>& left = drawn.strand[kLeft];
      ASSERT_NEAR(left.length + left.wrap, paid.chains.left, 1e-9)
          << any.effect << "." << any.info.name;
    }
  }
}
