// The registry: every physical effect the firmware knows, in the order it is applied.
// To add an effect, write its header in effects/, include it here and give it a line in the list.
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

// The order runs from the frame through the hanging chain to the links that the sprocket counts:
// where the chain runs, how much longer than the straight line it is, how many links it has, what
// the motor counts.
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

/// How many parameters all effects have together, and how many coefficients.
enum {
  kEffectParamCount = Effects::For<float>::kParamCount,
  kEffectCoefficientCount = Effects::For<float>::kCoefficientCount
};

}  // namespace kinematics
