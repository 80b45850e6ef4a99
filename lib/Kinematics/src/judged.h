// A machine in the numbers of the judge (tools/judge/reference/numbers.h), for tests and the bench.
#pragma once

#include "machine.h"

namespace kinematics {

namespace judged_detail {

/// Passes each effect's parameters on, in the registry's order.
template <class Real, class Judge>
struct EachEffect {
  const Frame<Real>& frame;
  const Real* parameter;
  Judge& judge;

  template <class ThisEffect>
  void effect(int) {
    ThisEffect::setJudge(frame, parameter, judge);
    parameter += ThisEffect::kParamCount;
  }
};

}  // namespace judged_detail

/// Describes a whole machine by judge.set(name, value) and judge.scale(name, factor). A factor
/// applies to the last value set, whichever call comes first. The feed is left out.
template <class Real, class Judge>
void setJudge(const Frame<Real>& frame, const EffectParams<Real>& effects, Judge& judge) {
  judge.set("motor_gap", frame.motor_gap);
  judge.set("motor_height", frame.motor_height);
  judge.set("motor_center_x", frame.motor_center_x);
  judge.set("rotation_radius", frame.rotation_radius);
  judge.set("sprocket_radius", frame.sprocket_radius);
  judge.set("sled_weight", frame.sled_weight);
  judge.set("left.weight", frame.chain_weight);
  judge.set("right.weight", frame.chain_weight);
  judged_detail::EachEffect<Real, Judge> each = {frame, effects.value, judge};
  Effects::For<Real>::visit(each);
}

}  // namespace kinematics
