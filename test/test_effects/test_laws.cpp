// The laws every registered effect obeys: zero means absent, zero has a slope, sizes are sane.
#include <Kinematics.h>
#include <gtest/gtest.h>
#include <math.h>
#include <string.h>

#include <algorithm>
#include <string>
#include <vector>

using namespace kinematics;

namespace {

/// A parameter of the registry: where it stands and what is said of it.
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

  template <class Own>
  void effect(int first_setting) {
    effects.push_back(Own::info());
    for (uint8_t i = 0; i < Own::kParamCount; ++i)
      all.push_back({Own::info().name, int(all.size()), first_setting + i, Own::param(i)});
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

/// Sum over places and sides of |length with one parameter at `size` - length without effects|.
double effectOf(const AnyParam& any, double size) {
  EffectParams<double> none = {}, one = {};
  one.value[any.index] = size;
  const Machine<double> bare = machineWith(none), changed = machineWith(one);
  double sum = 0;
  for (const Point<double>& place : places<double>()) {
    const Chains<double> a = inverse(bare, place).chains, b = inverse(changed, place).chains;
    sum += fabs(a.left - b.left) + fabs(a.right - b.right);
  }
  return sum;
}

}  // namespace

class EveryParam : public testing::TestWithParam<AnyParam> {};
INSTANTIATE_TEST_SUITE_P(Registry, EveryParam, testing::ValuesIn(everyParam()),
                         [](const testing::TestParamInfo<AnyParam>& tested) {
                           return tested.param.effect + "_" + tested.param.info.name;
                         });

TEST_P(EveryParam, IsFeltFromZero) {
  // The slope at zero must not vanish: half a size has about half the effect, not a quarter.
  const double small = 1e-4 * GetParam().info.typical;
  const double whole = effectOf(GetParam(), small), half = effectOf(GetParam(), small / 2);
  ASSERT_GT(whole, 0);
  EXPECT_NEAR(0.5, half / whole, 0.02);
}

TEST_P(EveryParam, TypicalSizeIsSeenButNotAbsurd) {
  const double mean =
      effectOf(GetParam(), GetParam().info.typical) / (2.0 * double(places<double>().size()));
  EXPECT_GT(mean, 0.005) << "mm of chain";
  EXPECT_LT(mean, 50) << "mm of chain";
}

TEST_P(EveryParam, SaysWhatItIs) {
  const ParamInfo& info = GetParam().info;
  EXPECT_LT(info.low, info.high);
  EXPECT_LE(info.low, info.typical);
  EXPECT_GE(info.high, info.typical);
  EXPECT_LE(info.low, 0) << "absence must be plausible";
  EXPECT_GT(strlen(info.summary), 10u);
  EXPECT_GE(GetParam().setting, 100);
  EXPECT_LE(GetParam().setting, 255);
}

TEST(Registry, ZeroMeansAbsentToTheLastBit) {
  // Whatever the forces are: forcing them to be worked out must change nothing either.
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

TEST(Registry, OneEffectNeverTouchesAnothersParameters) {
  for (const AnyParam& any : everyParam()) {
    EffectParams<double> one = {};
    one.value[any.index] = any.info.typical;
    const Machine<double> machine = machineWith(one);
    for (const AnyParam& other : everyParam())
      if (other.index != any.index) {
        EXPECT_EQ(0, machine.coefficient[other.index]);
      }
    EXPECT_NE(0, machine.coefficient[any.index]);
  }
}

TEST(Registry, EveryEffectSpeaksToPeople) {
  for (const EffectInfo& info : collect().effects) {
    EXPECT_GT(strlen(info.summary), 20u) << info.name;
    EXPECT_GT(strlen(info.pattern), 20u) << info.name;
    EXPECT_GT(strlen(info.remedy), 20u) << info.name;
  }
}

TEST(Registry, PublishedNumbersKeepTheirMeaning) {
  // Owners have these in their EEPROM: a change here changes their machines.
  std::vector<std::string> numbers;
  for (const AnyParam& any : everyParam())
    numbers.push_back(std::to_string(any.setting) + " " + any.effect + "." + any.info.name);
  const std::vector<std::string> released = {"100 chain_sag.weight_ratio_squared",
                                             "110 chain_stretch.compliance", "120 chain_pitch.left",
                                             "121 chain_pitch.right"};
  for (const std::string& number : released)
    EXPECT_NE(numbers.end(), std::find(numbers.begin(), numbers.end(), number)) << number;
}
