// Effect parameters by the number of their settings.
#pragma once

#include <Kinematics.h>

#include <initializer_list>

struct Sized {
  int setting;
  double size;
};

/// Only the named effects, all others absent; throws for a number that no effect has.
inline kinematics::EffectParams<double> withEffects(std::initializer_list<Sized> named) {
  kinematics::EffectParams<double> effects = {};
  for (const Sized& sized : named)
    if (!effects.set(sized.setting, sized.size)) throw sized.setting;
  return effects;
}
