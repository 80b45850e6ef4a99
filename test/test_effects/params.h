// Effect parameters by the number of their settings.
#pragma once

#include <Kinematics.h>

#include <initializer_list>

struct Sized {
  int setting;
  double size;
};

/// All effects absent but those named; throws for a number that no effect has.
inline kinematics::EffectParams<double> withEffects(std::initializer_list<Sized> named) {
  kinematics::EffectParams<double> effects = {};
  for (const Sized& one : named)
    if (!effects.set(one.setting, one.size)) throw one.setting;
  return effects;
}
