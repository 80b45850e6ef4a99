// The machine as it is before anybody has measured it.
#pragma once

#include <Kinematics.h>

/// Effects that no machine is without, at their usual size; the others are absent.
struct DefaultEffects {
  float* next;

  template <class Own>
  void effect(int first_setting) {
    for (uint8_t i = 0; i < Own::kParamCount; ++i) next[i] = 0;
    if (first_setting == 160) next[0] = 8.2e-12f;  // [1/mm^2] chain_sag.weight_ratio_squared
    if (first_setting == 170) next[0] = 5.2e-6f;   // [1/N] chain_stretch.compliance
    next += Own::kParamCount;
  }
};

inline kinematics::Machine<float> defaultMachine() {
  kinematics::Frame<float> frame;
  frame.motor_gap = 2978.4f;
  frame.motor_height = 1072.6f;
  frame.motor_center_x = 0;
  frame.rotation_radius = 139.1f;
  frame.sprocket_radius = 10.1063f;
  frame.sled_weight = 97.9f;
  frame.chain_weight = 0.00137293f;
  frame.feed = kinematics::Feed::kOverTop;
  kinematics::EffectParams<float> effects;
  DefaultEffects defaults = {effects.value};
  kinematics::Effects::For<float>::visit(defaults);
  return kinematics::prepare(frame, effects);
}
