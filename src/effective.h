// Settings as the kinematics wants them: what the published numbers mean, and ours added to them.
// Why just so: docs/decisions/0007-published-numbers-keep-their-meaning.md.
#pragma once

#include <quadrilateral.h>

#include "settings_table.h"

/// What prepare() of the ring's kinematics needs.
struct Geometry {
  kinematics::Frame<float> frame;
  kinematics::EffectParams<float> effects;
};

namespace effective_detail {

const float kTurn = 6.28318531f;  // [rad]

inline void add(kinematics::EffectParams<float>& effects, int setting, float amount) {
  effects.value[kinematics::Effects::For<float>::indexOf(setting)] += amount;
}

/// By how much the published sag exceeds ours, because it takes the arm for chain: with u the arm's
/// share of the line, line^3 against chain^3 (1 + 3 u). Told at the longest line on the sheet,
/// where nearly all sag is.
inline float sagOfArm(const kinematics::Frame<float>& frame, float width, float height) {
  const float across = 0.5f * (frame.motor_gap + width), down = frame.motor_height + 0.5f * height;
  const float share = frame.rotation_radius / float(sqrt(across * across + down * down));
  const float chain = 1 - share;
  return 1 / (chain * chain * chain * (1 + 3 * share));
}

/// One tolerance [%] into strain, and into the zero by which the published formula, which divides
/// the arm as well as the chain, is short of ours.
inline void addTolerance(Geometry& geometry, float percent, int strain_setting, int zero_setting) {
  const float strain = percent * 0.01f;
  add(geometry.effects, strain_setting, strain);
  add(geometry.effects, zero_setting, geometry.frame.rotation_radius * strain / (1 + strain));
}

}  // namespace effective_detail

/// The frame that settings describe.
inline kinematics::Frame<float> frameOf(const settings::Values& values) {
  kinematics::Frame<float> frame;
  frame.motor_gap = values.at(kMotorGap);
  frame.motor_height = 0.5f * values.at(kSheetHeight) + values.at(kMotorOffset);
  frame.motor_center_x = values.at(kMotorCenterX);
  frame.rotation_radius = values.at(kRotationRadius);
  frame.sprocket_radius = values.at(kChainPerTurn) / effective_detail::kTurn;
  frame.sled_weight = values.at(kSledWeight);
  frame.chain_weight = values.at(kChainWeight);
  frame.feed =
      values.at(kFeedSide) == 1 ? kinematics::Feed::kOverTop : kinematics::Feed::kOffBottom;
  return frame;
}

/// Frame and effects of a sled with a ring ($7 = 2).
inline Geometry geometryOf(const settings::Values& values) {
  using namespace effective_detail;
  Geometry geometry = {frameOf(values), {}};
  for (uint8_t i = 0; i < kinematics::kEffectParamCount; ++i)
    geometry.effects.value[i] = values.at(uint8_t(kFirstEffectSetting + i));
  const float sag = values.at(kSagCorrection) * 1e-12f;
  if (sag != 0)
    add(geometry.effects, 160,
        sag * sagOfArm(geometry.frame, values.at(kSheetWidth), values.at(kSheetHeight)));
  addTolerance(geometry, values.at(kLeftTolerance), 180, 200);
  addTolerance(geometry, values.at(kRightTolerance), 181, 201);
  return geometry;
}

/// The sled with two brackets ($7 = 1).
inline kinematics::BracketSled<float> bracketSledOf(const settings::Values& values) {
  return {values.at(kMountGap), values.at(kMountHeight), values.at(kCenterDepth)};
}

/// Its chains' strain: ours alone, as the published firmware ignores the tolerances there.
inline kinematics::PitchStrain<float> pitchOf(const settings::Values& values) {
  const int first = kinematics::Effects::For<float>::indexOf(180);
  return {values.at(uint8_t(kFirstEffectSetting + first)),
          values.at(uint8_t(kFirstEffectSetting + first + 1))};
}
