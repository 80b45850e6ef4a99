// How tight, how slack and how soft the sled hangs. Derivation: docs/kinematics.md, "How soft the
// sled hangs".
#include "reach.h"

#include <math.h>

namespace kinematics {

namespace {

// The load is multiplied and divided by this factor. A sag falls with the square of the tension,
// so its slope comes out 0.3 per cent too steep. A smaller factor would drown in float's rounding.
const float kHeavier = 1.0625f;

/// Both strands if the sled stayed where it is under `times` its load. Both chains then pull more,
/// and every effect responds to that as in inverse().
template <class Real>
Hanging<Real> hangUnder(Machine<Real>& machine, Point<Real> bit, Real times) {
  machine.load_at_nothing *= times;
  machine.load_slope *= times;
  return hang(machine, bit, true);
}

/// How far each chain's end gives [mm/N]: with more pull, less chain reaches equally far.
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

/// The sled's give [mm/N] by its chains alone. A force f along the sheet changes both tensions by t
/// with J^T t = f, where the rows of J are the strands' directions from sprocket to bit. Each chain
/// reaches farther by its give times t. The bit moves by p so that both lengths fit: J p = those
/// lengths.
template <class Real>
Give<Real> giveOfChains(const Hanging<Real>& hanging, const Chains<Real>& each) {
  const Strand<Real>& left = hanging.strand[kLeft];
  const Strand<Real>& right = hanging.strand[kRight];
  const Real scale = Real(1) / hanging.sine_of_sum;
  // How far the bit moves per mm of each chain.
  const Point<Real> by_left = {right.sine * scale, -right.cosine * scale};
  const Point<Real> by_right = {-left.sine * scale, -left.cosine * scale};
  return {each.left * by_left.x * by_left.x + each.right * by_right.x * by_right.x,
          each.left * by_left.x * by_left.y + each.right * by_right.x * by_right.y,
          each.left * by_left.y * by_left.y + each.right * by_right.y * by_right.y};
}

/// The give [mm/N] with what turning strands add: a strand of tension T and length D resists moves
/// of its end across it with T / D. Chains that do not give hold the sled without this help.
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
  // (1 + give * stiff)^-1 give for two symmetric 2 x 2 matrices, by Cramer's rule.
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
    // The sprocket carries the upper half of the chain too: `pull` is the tension at its middle.
    reached.tension[side] =
        tension[side] + machine.frame.chain_weight * strand.free * strand.sine * Real(0.5);
  }
  const Give<Real> loose = giveOfChains(hanging, giveOfEach(machine, bit));
  reached.give = heldByTurning(hanging, loose, tension, machine.rotation_radius);
  const Real all = reached.tension[kLeft] + reached.tension[kRight] + mostGive(reached.give);
  // A place that is NaN, or too far away for a float, ends here.
  if (!isfinite(all)) return {Reach::kCannotHang, {Real(0), Real(0)}, none};
  reached.verdict = verdictOn(reached, limits);
  return reached;
}

template float mostGive(const Give<float>&);
template Reached<float> reach(const Machine<float>&, Point<float>, const ReachLimits<float>&);

template double mostGive(const Give<double>&);
template Reached<double> reach(const Machine<double>&, Point<double>, const ReachLimits<double>&);

}  // namespace kinematics
