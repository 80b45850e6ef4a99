// How tight, how slack and how soft the sled hangs. Derivation: ../README.md, "How soft it hangs".
#include "reach.h"

#include <math.h>

namespace kinematics {

namespace {

// The load is tried this many times as large, and as small. The slope of a sag that falls with the
// tension's square comes out 0.3 per cent too steep; a smaller step drowns in float's rounding.
const float kHeavier = 1.0625f;

/// Both strands if the sled stayed where it is under `times` its load: both chains then pull more,
/// and every effect answers to that as it does in inverse().
template <class Real>
Hanging<Real> hangUnder(Machine<Real>& machine, Point<Real> bit, Real times) {
  machine.load_at_nothing *= times;
  machine.load_slope *= times;
  return hang(machine, bit, true);
}

/// How far each chain's end gives [mm/N]: less of a chain reaches as far when it pulls more.
template <class Real>
Chains<Real> giveOfEach(Machine<Real> machine, Point<Real> bit) {
  const Real more = Real(kHeavier);
  const Real less = Real(1) / more;
  const Hanging<Real> tight = hangUnder(machine, bit, more);
  const Hanging<Real> slack = hangUnder(machine, bit, less * less);
  const Chains<Real> shorter = paidOut(tight);
  const Chains<Real> longer = paidOut(slack);
  const Real weight = machine.frame.sled_weight;
  const Real left = (tight.strand[kLeft].pull - slack.strand[kLeft].pull) * weight;
  const Real right = (tight.strand[kRight].pull - slack.strand[kRight].pull) * weight;
  return {(longer.left - shorter.left) / left, (longer.right - shorter.right) / right};
}

/// The sled's give by its chains alone. A force f along the sheet changes both tensions by t with
/// J^T t = f, rows of J being the strands' directions from sprocket to bit; each chain reaches
/// farther by its give times t; and the bit goes where both lengths fit: J p = those lengths.
template <class Real>
Give<Real> giveOfChains(const Hanging<Real>& hanging, const Chains<Real>& each) {
  const Strand<Real>& left = hanging.strand[kLeft];
  const Strand<Real>& right = hanging.strand[kRight];
  const Real scale = Real(1) / hanging.sine_of_sum;
  // Where the bit goes per mm of either chain.
  const Point<Real> by_left = {right.sine * scale, -right.cosine * scale};
  const Point<Real> by_right = {-left.sine * scale, -left.cosine * scale};
  return {each.left * by_left.x * by_left.x + each.right * by_right.x * by_right.x,
          each.left * by_left.x * by_left.y + each.right * by_right.x * by_right.y,
          each.left * by_left.y * by_left.y + each.right * by_right.y * by_right.y};
}

/// The same with what turning strands add: a strand of tension T and length D resists its end's
/// moves across it with T / D. Chains that do not give hold the sled without this help.
template <class Real>
Give<Real> heldByTurning(const Hanging<Real>& hanging, const Give<Real>& give, const Real* tension,
                         Real arm) {
  Give<Real> stiff = {Real(0), Real(0), Real(0)};  // [N/mm]
  for (uint8_t side = kLeft; side < kSideCount; ++side) {
    const Strand<Real>& strand = hanging.strand[side];
    const Real across = tension[side] / (strand.free + arm);
    const Real mixed = across * strand.sine * strand.cosine;
    stiff.xx += across * strand.sine * strand.sine;
    stiff.xy += side == kLeft ? mixed : -mixed;
    stiff.yy += across * strand.cosine * strand.cosine;
  }
  // (1 + give * stiff)^-1 give, worked out for two symmetric matrices: the products of both mixed
  // terms meet in one determinant, and the rest is give and its adjoint's share.
  const Real area = give.xx * give.yy - give.xy * give.xy;
  const Real hold = Real(1) + give.xx * stiff.xx + Real(2) * give.xy * stiff.xy +
                    give.yy * stiff.yy + area * (stiff.xx * stiff.yy - stiff.xy * stiff.xy);
  const Real share = Real(1) / hold;
  return {(give.xx + area * stiff.yy) * share, (give.xy - area * stiff.xy) * share,
          (give.yy + area * stiff.xx) * share};
}

template <class Real>
Reach verdictOn(const Reached<Real>& reached, const ReachLimits<Real>& limits) {
  const Real left = reached.tension[kLeft];
  const Real right = reached.tension[kRight];
  if (left > limits.most_tension || right > limits.most_tension) return Reach::kTooTight;
  if (left < limits.least_tension || right < limits.least_tension) return Reach::kTooSlack;
  return mostGive(reached.give) > limits.most_give ? Reach::kTooVertical : Reach::kUsable;
}

}  // namespace

template <class Real>
Real mostGive(const Give<Real>& give) {
  const Real half = (give.xx - give.yy) * Real(0.5);
  return (give.xx + give.yy) * Real(0.5) + sqrt(half * half + give.xy * give.xy);
}

template <class Real>
Reached<Real> reach(const Machine<Real>& machine, Point<Real> bit,
                    const ReachLimits<Real>& limits) {
  const Give<Real> none = {Real(0), Real(0), Real(0)};
  Reached<Real> reached = {Reach::kCannotHang, {Real(0), Real(0)}, none};
  const Hanging<Real> hanging = hang(machine, bit, true);
  const Strand<Real>& left = hanging.strand[kLeft];
  const Strand<Real>& right = hanging.strand[kRight];
  const bool clear = left.free >= limits.least_free && right.free >= limits.least_free;
  if (hanging.found != Found::kYes || !clear) return reached;
  Real tension[kSideCount];
  for (uint8_t side = kLeft; side < kSideCount; ++side) {
    const Strand<Real>& strand = hanging.strand[side];
    tension[side] = strand.pull * machine.frame.sled_weight;
    // Down to the middle of the chain its upper half hangs on the sprocket as well.
    reached.tension[side] =
        tension[side] + machine.frame.chain_weight * strand.free * strand.sine * Real(0.5);
  }
  const Give<Real> loose = giveOfChains(hanging, giveOfEach(machine, bit));
  reached.give = heldByTurning(hanging, loose, tension, machine.rotation_radius);
  const Real all = reached.tension[kLeft] + reached.tension[kRight] + mostGive(reached.give);
  // Places that are no numbers, or too far for one, end here.
  if (!isfinite(all)) return {Reach::kCannotHang, {Real(0), Real(0)}, none};
  reached.verdict = verdictOn(reached, limits);
  return reached;
}

template float mostGive(const Give<float>&);
template Reached<float> reach(const Machine<float>&, Point<float>, const ReachLimits<float>&);

template double mostGive(const Give<double>&);
template Reached<double> reach(const Machine<double>&, Point<double>, const ReachLimits<double>&);

}  // namespace kinematics
