// The registry: every physical effect the firmware knows, in the order it is applied.
// To add one, write its header in effects/, include it here and give it a line.
#pragma once

#include "effects/chain_pitch.h"
#include "effects/chain_plane.h"
#include "effects/chain_sag.h"
#include "effects/chain_stretch.h"
#include "effects/chain_zero.h"
#include "effects/frame_flex.h"
#include "effects/frame_lean.h"
#include "effects/motor_level.h"
#include "effects/residual_patch.h"
#include "effects/sled_swing.h"
#include "effects/sprocket_runout.h"
#include "registry.h"

namespace kinematics {

// From the frame through the hanging chain to links counted by the sprocket: where the chain runs,
// how much longer than the straight line it is, how many links that makes, what the motor counts.
// clang-format off
using Effects = Registry<
    At<100, MotorLevel>,
    At<110, FrameFlex>,
    At<120, SledSwing>,
    At<130, ChainPlane>,
    At<150, FrameLean>,
    At<160, ChainSag>,
    At<170, ChainStretch>,
    At<180, ChainPitch>,
    At<190, SprocketRunout>,
    At<200, ChainZero>,
    At<210, ResidualPatch>>;
// clang-format on

/// How many numbers describe all effects together, and how many their hooks read.
enum {
  kEffectParamCount = Effects::For<float>::kParamCount,
  kEffectCoefficientCount = Effects::For<float>::kCoefficientCount
};

}  // namespace kinematics
