// Settings as the kinematics needs them: published numbers translated, ours added. The reasons:
// docs/decisions/0007-published-numbers-keep-their-meaning.md.
#pragma once

#include <quadrilateral.h>

#include "settings_table.h"

/// Input of prepare() for a sled on a ring.
struct Geometry {
  kinematics::Frame<float> frame;
  kinematics::EffectParams<float> effects;
};

namespace effective_detail {

const float kTurn = 6.28318531f;  // [rad]

/// The chains as the numbers of the published firmware describe them.
inline kinematics::PublishedChains<float> publishedChains(const settings::Values& values) {
  return {values.at(kSagCorrection) * 1e-12f,
          {values.at(kLeftTolerance) * 0.01f, values.at(kRightTolerance) * 0.01f},
          values.at(kSheetWidth),
          values.at(kSheetHeight)};
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
  kinematics::Effects::For<float>::addPublished(geometry.frame, publishedChains(values),
                                                geometry.effects.value);
  return geometry;
}

/// The sled with two brackets ($7 = 1).
inline kinematics::BracketSled<float> bracketSledOf(const settings::Values& values) {
  return {values.at(kMountGap), values.at(kMountHeight), values.at(kCenterDepth)};
}

/// Strain of that sled's chains: from our numbers alone, because the published firmware ignores the
/// tolerances for such a sled.
inline kinematics::PitchStrain<float> pitchOf(const settings::Values& values) {
  return kinematics::pitchAmong<float>(
      [&](uint8_t index) { return values.at(uint8_t(kFirstEffectSetting + index)); });
}
