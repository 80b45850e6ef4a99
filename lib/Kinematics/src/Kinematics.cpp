// Inverse and iterative forward kinematics of the hanging sled, written once for every number type.
// Formulas, drawings and derivations: ../README.md.
#include "Kinematics.h"

#include <math.h>

namespace kinematics {

namespace {

// wrap of a chain towards a direction with sine s and cosine c below the horizontal is
// radius * angle, and angle = pi/4 + asin((s - c) / sqrt(2)). On |s - c| <= 0.92, which holds all
// sheets and frames in use, these odd coefficients give it within 0.000075 rad: 0.0008 mm.
const double kQuarterPi = 0.78539816339744831;
const double kPi = 3.14159265358979324;
const double kArc[3] = {0.70765381748407, 0.05426413800989, 0.02263918070638};

// Flatter strands than this would carry over thirty times the sled's weight: no machine does.
const float kFlattest = 1.0f / 64;

const uint8_t kMostTries = 20;
// The slopes leave out that sag and stretch change along a step. What a step misses for this is
// 2 to 8 per cent of it on the sheet, so after a step this short less than 0.005 mm is missing.
const float kLastStep = 0.06f;  // [mm]
// Longer steps than this leave the neighbourhood in which the slopes mean anything.
const float kLongestStep = 400.0f;  // [mm]

/// The straight line from one sprocket to the bit, and what it would take of rigid chain.
template <class Real>
void drawStraight(const Machine<Real>& machine, Point<Real> bit, Strand<Real>& strand) {
  const Point<Real> center = machine.sprocket[strand.side].center;
  const Real run = strand.side == kLeft ? bit.x - center.x : center.x - bit.x;
  const Real drop = center.y - bit.y;
  const Real distance = sqrt(run * run + drop * drop);
  const Real per_distance = Real(1) / distance;
  strand.per_distance = per_distance;
  const Real sine = drop * per_distance;
  const Real cosine = run * per_distance;
  const Real u = sine - cosine;
  const Real v = u * u;
  const Real* k = machine.wrap_slope;
  // Straight line sqrt(d^2 - r^2) and wrap r * (angle of centres + asin(r / d)): the series of
  // both give d + r^2 / (2 d) + r * angle; what is left out is below 0.00001 mm.
  strand.straight = distance + machine.half_radius_squared * per_distance +
                    (machine.wrap_less_arm + u * (k[0] + v * (k[1] + v * k[2])));
  strand.free = distance - machine.frame.rotation_radius;  // within 0.1 mm: scales corrections
  strand.free_share = strand.free * per_distance;
  // Line of centres to tangent line: the chain leaves the sprocket r / d steeper.
  const Real turn = machine.feed_radius * per_distance;
  strand.sine = sine + cosine * turn;
  strand.cosine = cosine - sine * turn;
  strand.extra = Real(0);
}

/// Tensions of two strands that hold the sled and half their own weight (moments about the
/// sprockets: a chain's weight acts at half its length, so free / reach of that half is carried
/// by the sled).
template <class Real>
void shareLoad(const Machine<Real>& machine, Hanging<Real>& hanging) {
  Strand<Real>& left = hanging.strand[kLeft];
  Strand<Real>& right = hanging.strand[kRight];
  const Real carried = left.free * left.free_share + right.free * right.free_share;
  const Real load = Real(1) + machine.half_weight_ratio * carried;
  const Real cosines = left.cosine * right.cosine;
  const Real pull = load / hanging.sine_of_sum;       // tension / (weight * other cosine)
  const Real slackness = Real(1) / (pull * cosines);  // weight / horizontal pull
  left.bend = left.cosine * left.cosine * slackness;
  right.bend = right.cosine * right.cosine * slackness;
  const Real newtons = pull * machine.frame.sled_weight;
  left.tension = newtons * right.cosine;
  right.tension = newtons * left.cosine;
}

template <class Real>
bool canHang(const Machine<Real>& machine, const Hanging<Real>& hanging) {
  for (uint8_t side = kLeft; side < kSideCount; ++side) {
    const Strand<Real>& strand = hanging.strand[side];
    // Written so that a NaN anywhere fails.
    if (!(strand.cosine > Real(0) && strand.free > machine.frame.sprocket_radius)) return false;
  }
  return hanging.sine_of_sum > Real(kFlattest);
}

template <class Real>
Chains<Real> paidOut(const Hanging<Real>& hanging) {
  return {hanging.strand[kLeft].straight + hanging.strand[kLeft].extra,
          hanging.strand[kRight].straight + hanging.strand[kRight].extra};
}

template <class Real>
Real clamp(Real value, Real low, Real high) {
  if (value > high) return high;
  return value > low ? value : low;  // a NaN ends here too
}

template <class Real>
Real clampStep(Real step) {
  return clamp(step, Real(-kLongestStep), Real(kLongestStep));
}

/// The nearest place that has slopes: below the motors and between them.
template <class Real>
Point<Real> insideReach(const Machine<Real>& machine, Point<Real> place) {
  const Point<Real> left = machine.sprocket[kLeft].center;
  const Point<Real> right = machine.sprocket[kRight].center;
  const Real margin = machine.frame.motor_gap * Real(kFlattest);
  const Real top = left.y < right.y ? left.y : right.y;
  return {clamp(place.x, left.x + margin, right.x - margin),
          clamp(place.y, top - Real(4) * machine.frame.motor_gap, top - margin)};
}

/// One Newton step [mm]: the slopes of both lengths are the directions of the strands.
template <class Real>
Point<Real> stepTowards(const Hanging<Real>& hanging, Real left_error, Real right_error) {
  const Strand<Real>& left = hanging.strand[kLeft];
  const Strand<Real>& right = hanging.strand[kRight];
  const Real scale = Real(1) / hanging.sine_of_sum;
  return {(right.sine * left_error - left.sine * right_error) * scale,
          -(right.cosine * left_error + left.cosine * right_error) * scale};
}

/// Whether the chains, laid straight from sprocket to sprocket, reach each other at all.
template <class Real>
bool canMeet(const Machine<Real>& machine, Chains<Real> chains) {
  const Real arms = machine.frame.rotation_radius + machine.frame.rotation_radius;
  const Real sum = chains.left + chains.right + arms;
  return sum > machine.frame.motor_gap && sum < Real(8) * machine.frame.motor_gap;
}

/// Where two straight chains meet whose wrap is that of a 45 degree strand.
template <class Real>
Point<Real> meetStraight(const Machine<Real>& machine, Chains<Real> chains) {
  const Real more = machine.frame.rotation_radius - machine.wrap_middle;
  const Real left = chains.left + more;
  const Real right = chains.right + more;
  const Real gap = machine.frame.motor_gap;
  const Point<Real> center = machine.sprocket[kLeft].center;
  const Real run = (gap + (left - right) * (left + right) / gap) * Real(0.5);
  const Real drop_squared = left * left - run * run;
  const Real drop = drop_squared > Real(0) ? sqrt(drop_squared) : Real(0);
  return {center.x + run, center.y - drop};
}

}  // namespace

template <class Real>
Machine<Real> prepare(const Frame<Real>& frame, const EffectParams<Real>& effects) {
  Machine<Real> machine;
  machine.frame = frame;
  const Real half_gap = frame.motor_gap * Real(0.5);
  machine.sprocket[kLeft].center = {frame.motor_center_x - half_gap, frame.motor_height};
  machine.sprocket[kRight].center = {frame.motor_center_x + half_gap, frame.motor_height};
  const bool over_top = frame.feed == Feed::kOverTop;
  machine.feed_radius = over_top ? frame.sprocket_radius : -frame.sprocket_radius;
  machine.half_radius_squared = frame.sprocket_radius * frame.sprocket_radius * Real(0.5);
  // Off the bottom the chain first goes round from 12 to 6 o'clock.
  machine.wrap_middle = machine.feed_radius * Real(kQuarterPi);
  if (!over_top) machine.wrap_middle += frame.sprocket_radius * Real(kPi);
  for (uint8_t i = 0; i < 3; ++i) machine.wrap_slope[i] = machine.feed_radius * Real(kArc[i]);
  machine.wrap_less_arm = machine.wrap_middle - frame.rotation_radius;
  machine.half_weight_ratio = frame.chain_weight / frame.sled_weight * Real(0.5);
  typedef Effects::For<Real> All;
  machine.present = All::presentMask(effects.value);
  machine.forces = (machine.present & All::kForceMask) != 0;
  All::prepare(effects.value, machine.coefficient);
  return machine;
}

template <class Real>
Hanging<Real> hang(const Machine<Real>& machine, Point<Real> bit) {
  Hanging<Real> hanging;
  Strand<Real>& left = hanging.strand[kLeft];
  Strand<Real>& right = hanging.strand[kRight];
  left.side = kLeft;
  right.side = kRight;
  drawStraight(machine, bit, left);
  drawStraight(machine, bit, right);
  hanging.sine_of_sum = left.sine * right.cosine + left.cosine * right.sine;
  if (machine.forces) shareLoad(machine, hanging);
  for (uint8_t side = kLeft; side < kSideCount; ++side)
    Effects::For<Real>::adjustLength(machine.coefficient, machine.present, hanging.strand[side]);
  hanging.found = canHang(machine, hanging) ? Found::kYes : Found::kOutOfReach;
  return hanging;
}

template <class Real>
PaidOut<Real> inverse(const Machine<Real>& machine, Point<Real> bit) {
  const Hanging<Real> hanging = hang(machine, bit);
  if (hanging.found != Found::kYes) return {{Real(0), Real(0)}, hanging.found};
  return {paidOut(hanging), Found::kYes};
}

template <class Real>
Place<Real> forward(const Machine<Real>& machine, Chains<Real> chains, Point<Real> guess) {
  Place<Real> place = {guess, Found::kOutOfReach, 0};
  if (!canMeet(machine, chains)) return place;
  place.sled = insideReach(machine, guess);
  bool held = false;
  for (place.tries = 1; place.tries <= kMostTries; ++place.tries) {
    const Hanging<Real> hanging = hang(machine, place.sled);
    const Chains<Real> now = paidOut(hanging);
    const Point<Real> step = stepTowards(hanging, chains.left - now.left, chains.right - now.right);
    const Point<Real> next = {place.sled.x + clampStep(step.x), place.sled.y + clampStep(step.y)};
    place.sled = insideReach(machine, next);
    held = place.sled.x != next.x || place.sled.y != next.y;
    place.found = hanging.found;
    if (fabs(step.x) < Real(kLastStep) && fabs(step.y) < Real(kLastStep)) return place;
  }
  // A search that ends pressed against the edge of what can hang was sent beyond it.
  place.found = held ? Found::kOutOfReach : Found::kTooManyTries;
  return place;
}

template <class Real>
Place<Real> forward(const Machine<Real>& machine, Chains<Real> chains) {
  return forward(machine, chains, meetStraight(machine, chains));
}

template Machine<float> prepare(const Frame<float>&, const EffectParams<float>&);
template Hanging<float> hang(const Machine<float>&, Point<float>);
template PaidOut<float> inverse(const Machine<float>&, Point<float>);
template Place<float> forward(const Machine<float>&, Chains<float>);
template Place<float> forward(const Machine<float>&, Chains<float>, Point<float>);

// The lab's instance; the linker drops it from the board, where nobody calls it.
template Machine<double> prepare(const Frame<double>&, const EffectParams<double>&);
template Hanging<double> hang(const Machine<double>&, Point<double>);
template PaidOut<double> inverse(const Machine<double>&, Point<double>);
template Place<double> forward(const Machine<double>&, Chains<double>);
template Place<double> forward(const Machine<double>&, Chains<double>, Point<double>);

}  // namespace kinematics
