// The registry: every physical effect the firmware knows, in the order it is applied.
// To add one, write its header in effects/, include it here and give it a line.
#pragma once

#include "effects/chain_pitch.h"
#include "effects/chain_sag.h"
#include "effects/chain_stretch.h"
#include "registry.h"

namespace kinematics {

// From the straight line to links counted by the sprocket: the hanging chain is longer than the
// line, shorter when its load is taken off, and fewer links when its links are long.
using Effects = Registry<At<100, ChainSag>, At<110, ChainStretch>, At<120, ChainPitch>>;

/// How many numbers describe all effects together.
enum { kEffectParamCount = Effects::For<float>::kParamCount };

}  // namespace kinematics
