// Every effect against the judge, which hides it by its own mechanics: a mount that moves under
// load, an eccentric sprocket, a chain out of plane in three dimensions, a sled that turns.
#include <Kinematics.h>
#include <gtest/gtest.h>
#include <math.h>

#include <functional>
#include <string>
#include <vector>

#include "params.h"
#include "reference/reference.h"

using namespace kinematics;

namespace {

const double kChainWeight = 0.00137293, kSledWeight = 97.9, kCompliance = 5.17e-6;
const double kRadius = 63.5 / 6.283185307179586;

/// A machine with one more effect, told to the judge and to the laws.
struct Hidden {
  std::string name;
  std::vector<Sized> sizes;                       // settings of the laws
  std::function<void(reference::Machine&)> hide;  // the same in the judge's words
  double allowed;                                 // [mm] of chain
};

void PrintTo(const Hidden& hidden, std::ostream* out) { *out << hidden.name; }

const double kLean = 0.2617994;  // 15 degrees

std::vector<Hidden> everyEffect() {
  typedef reference::Machine M;
  return {
      {"nothing", {}, [](M&) {}, 0.005},
      {"motor_level", {{100, 6}}, [](M& m) { m.height_difference = 6; }, 0.005},
      {"frame_flex_inward",
       {{110, 0.007}},
       [](M& m) { m.left.inward = m.right.inward = 0.007; },
       0.01},
      {"frame_flex_downward",
       {{111, 0.02}},
       [](M& m) { m.left.downward = m.right.downward = 0.02; },
       0.01},
      {"chain_plane", {{130, 1600}}, [](M& m) { m.plane_gap = 40; }, 0.008},
      {"frame_lean",
       {{150, tan(kLean) * tan(kLean)}},
       [](M& m) {
         // The frame's weights are those along the sheet; the judge wants the whole.
         m.lean = kLean;
         m.sled_weight /= cos(kLean);
         m.left.weight /= cos(kLean);
         m.right.weight /= cos(kLean);
       },
       0.01},
      {"chain_pitch",
       {{180, 0.002}, {181, 0.0005}},
       [](M& m) { m.left.pitch = 0.002, m.right.pitch = 0.0005; },
       0.006},
      {"sprocket_runout",
       {{190, -0.06}, {191, -0.08}},
       [](M& m) {
         m.left.eccentricity = {0.08, 0.06};
       },
       0.01},
      {"chain_zero",
       {{200, 6.35}, {201, -2}},
       [](M& m) { m.left.zero = 6.35, m.right.zero = -2; },
       0.005},
  };
}

Machine<double> lawsWith(const std::vector<Sized>& sizes) {
  const Frame<double> frame = {2978.4,       1072.6,        0, 139.1, kRadius, kSledWeight,
                               kChainWeight, Feed::kOverTop};
  const double ratio = kChainWeight / kSledWeight;
  EffectParams<double> effects = withEffects({{160, ratio * ratio / 24}, {170, kCompliance}});
  for (const Sized& one : sizes) EXPECT_TRUE(effects.set(one.setting, one.size));
  return prepare(frame, effects);
}

reference::Machine judge() {
  reference::Machine machine;
  machine.sprocket_radius = kRadius;
  machine.sled_weight = kSledWeight;
  for (reference::ChainSide* side : {&machine.left, &machine.right}) {
    side->weight = kChainWeight;
    side->compliance = kCompliance;
  }
  return machine;
}

std::vector<Eigen::Vector2d> places() {
  std::vector<Eigen::Vector2d> all;
  for (int i = 0; i <= 32; ++i)
    for (int j = 0; j <= 16; ++j) all.push_back({-1219.2 + 76.2 * i, -609.6 + 76.2 * j});
  return all;
}

double worst(const Chains<double>& ours, const Eigen::Vector2d& theirs) {
  return fmax(fabs(ours.left - theirs[0]), fabs(ours.right - theirs[1]));
}

}  // namespace

class AgainstJudge : public testing::TestWithParam<Hidden> {};
INSTANTIATE_TEST_SUITE_P(Effects, AgainstJudge, testing::ValuesIn(everyEffect()),
                         [](const testing::TestParamInfo<Hidden>& tested) {
                           return tested.param.name;
                         });

TEST_P(AgainstJudge, LengthsAgreeOverTheSheet) {
  reference::Machine machine = judge();
  GetParam().hide(machine);
  const Machine<double> laws = lawsWith(GetParam().sizes);
  double found = 0;
  for (const Eigen::Vector2d& place : places()) {
    const reference::Hang truth = reference::hangAt(machine, place);
    ASSERT_TRUE(truth.solved);
    found = fmax(found,
                 worst(inverse(laws, Point<double>{place.x(), place.y()}).chains, truth.paid_out));
  }
  RecordProperty("worst_mm", std::to_string(found));
  EXPECT_LT(found, GetParam().allowed);
}

TEST_P(AgainstJudge, WouldMissWithoutTheEffect) {
  if (GetParam().sizes.empty()) return;
  reference::Machine machine = judge();
  GetParam().hide(machine);
  const Machine<double> laws = lawsWith({});
  double missed = 0;
  for (const Eigen::Vector2d& place : places()) {
    const reference::Hang truth = reference::hangAt(machine, place);
    missed = fmax(missed,
                  worst(inverse(laws, Point<double>{place.x(), place.y()}).chains, truth.paid_out));
  }
  EXPECT_GT(missed, 8 * GetParam().allowed);
}

TEST(SledSwing, FollowsTheChainsEndsAtTheRing) {
  // The judge's ring hangs where its chains pull; the sled carries its bit about it, turned by half
  // the difference of both pulls' angles.
  const Eigen::Vector2d bit_from_ring(3, -2);
  const Machine<double> laws = lawsWith({{120, 3}, {121, -2}});
  const Machine<double> without = lawsWith({});
  double found = 0, missed = 0;
  for (const Eigen::Vector2d& place : places()) {
    Eigen::Vector2d ring = place;
    reference::Hang truth;
    for (int round = 0; round < 6; ++round) {
      truth = reference::hangAt(judge(), ring);
      ASSERT_TRUE(truth.solved);
      // Pulls are on the ring: up and outward.
      const double left = atan2(truth.left.pull.y(), -truth.left.pull.x());
      const double right = atan2(truth.right.pull.y(), truth.right.pull.x());
      const double turned = (right - left) / 2;
      ring = place + bit_from_ring - Eigen::Rotation2Dd(turned) * bit_from_ring;
    }
    const Point<double> at = {place.x(), place.y()};
    found = fmax(found, worst(inverse(laws, at).chains, truth.paid_out));
    missed = fmax(missed, worst(inverse(without, at).chains, truth.paid_out));
  }
  EXPECT_LT(found, 0.012);
  EXPECT_GT(missed, 0.5);
}
