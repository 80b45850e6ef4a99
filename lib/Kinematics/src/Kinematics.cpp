// Inverse and iterative forward kinematics of the hanging sled, written once for every number type.
// Formulas, drawings and derivations: docs/kinematics.md.
#include "Kinematics.h"

#include <math.h>
#include <string.h>

#include "search.h"

namespace kinematics {

namespace {

// The wrap of a chain towards a direction with sine s and cosine c below the horizontal is
// radius * angle, and angle = pi/4 + asin((s - c) / sqrt(2)). These odd coefficients give the angle
// within 0.00005 rad (0.0005 mm of chain) for |s - c| up to 0.88, and within 0.00024 rad at 0.92.
// No sheet on a frame in use reaches beyond 0.92.
const double kArc[3] = {0.70749505, 0.05527136, 0.02142412};

// The sled stays below the line of the motors by at least this share of their gap.
const float kFlattest = 1.0f / 128;

// Steps up to this length need no care; a longer step is cut so that it ends where slopes exist.
// (The slopes leave out that sag and stretch change along a step. A step misses 2 to 5 per cent of
// its length for this, 12 per cent at worst under a light sled.)
const float kSafeStep = 10.0f;  // [mm]

/// Whether a strand is so steep that hardly anything pulls on the other: its sag has no bound.
template <class Real>
bool isSteep(Real cosine) {
  return cosine < Real(1) / Real(32);
}

/// The same by the bits of a number: the board compares integers in a fifth of the time.
inline bool isSteep(float cosine) {
  const int32_t kBits = 0x3d000000;  // of 1 / 32
  int32_t bits;
  memcpy(&bits, &cosine, sizeof bits);
  return bits < kBits;
}

/// Free chain and direction of a strand; returns sine less cosine of the line from the sprocket's
/// centre to the bit.
template <class Real>
PLUMB_INLINE Real direct(const Machine<Real>& machine, Real run, Real drop, Real distance,
                         Strand<Real>& strand) {
  strand.free = distance - machine.rotation_radius;
  const Real per_distance = Real(1) / distance;
  const Real sine = drop * per_distance;
  const Real cosine = run * per_distance;
  // The tangent line is steeper than the line from the sprocket's centre by r / d.
  const Real turn = machine.feed_radius * per_distance;
  strand.sine = sine + cosine * turn;
  strand.cosine = cosine - sine * turn;
  return sine - cosine;
}

/// The straight line from a sprocket to the bit, and how much chain a rigid chain would need.
///
/// Tangent line sqrt(d^2 - r^2) and wrap r * (angle of centres + asin(r / d)) add up, by their
/// series, to d + r^2 / (2 d) + r * angle. The first two terms are sqrt(d^2 + r^2) within
/// 0.00001 mm. `drop_squared` [mm^2] already includes r^2.
template <class Real>
PLUMB_INLINE void drawStraight(const Machine<Real>& machine, Real run, Real drop, Real drop_squared,
                               bool directed, Strand<Real>& strand) {
  const Real distance = sqrt(run * run + drop_squared);
  Real u;
  if (directed) {
    u = direct(machine, run, drop, distance, strand);
  } else {
    strand.free = distance - machine.rotation_radius;
    u = (drop - run) / distance;
  }
  strand.length = strand.free;
  strand.wrap = machine.wrap.at(u);
}

/// Both strands, straight; their directions only if `directed`. Each strand's run and drop grow by
/// its `span` [mm], unless that is null.
template <class Real>
PLUMB_INLINE void drawBoth(const Machine<Real>& machine, Point<Real> bit, const Point<Real>* span,
                           bool directed, Hanging<Real>& hanging) {
  Real drop = machine.sprocket[kLeft].y - bit.y;
  Real drop_squared = drop * drop + machine.radius_squared;
  hanging.found = bit.y < machine.highest ? Found::kYes : Found::kOutOfReach;
  for (uint8_t side = kLeft; side < kSideCount; ++side) {
    const Real center = machine.sprocket[side].x;
    Real run = side == kLeft ? bit.x - center : center - bit.x;
    if (signbit(run)) hanging.found = Found::kOutOfReach;
    if (span || (side == kRight && !machine.level)) {
      drop = machine.sprocket[side].y - bit.y;
      if (span) {
        run += span[side].x;
        drop += span[side].y;
      }
      drop_squared = drop * drop + machine.radius_squared;
    }
    hanging.strand[side].side = Side(side);
    drawStraight(machine, run, drop, drop_squared, directed, hanging.strand[side]);
    if (directed && isSteep(hanging.strand[side].cosine)) hanging.found = Found::kOutOfReach;
  }
}

/// Sled and half of both chains' weight [1] in sled weights (moments about the sprockets: a chain's
/// weight acts at half its length, so free / reach of that half is carried by the sled).
template <class Real>
Real loadOf(const Machine<Real>& machine, const Strand<Real>* strand) {
  return machine.load_at_nothing + machine.load_slope * (strand[kLeft].free + strand[kRight].free);
}

/// Nothing pushes the sled. The board is compiled for this unless an effect pushes.
struct NoPush {};

/// Tensions of two strands that hold the load.
template <class Real>
PLUMB_INLINE void pull(Real scale, NoPush, Strand<Real>& left, Strand<Real>& right) {
  left.pull = scale * right.cosine;
  right.pull = scale * left.cosine;
  // Both strands have the same level pull, so a single division serves both.
  const Real per_level = Real(1) / (left.pull * left.cosine);
  left.slack = left.cosine * per_level;
  right.slack = right.cosine * per_level;
}

/// Tensions under a push on the sled: the strands' level pulls differ.
template <class Real>
void pull(Real scale, Point<Real> push, Strand<Real>& left, Strand<Real>& right) {
  const Real per_sum = Real(1) / (left.sine * right.cosine + left.cosine * right.sine);
  const Real across = push.x * per_sum;
  const Real down = scale - push.y * per_sum;
  left.pull = down * right.cosine + across * right.sine;
  right.pull = down * left.cosine - across * left.sine;
  left.slack = Real(1) / left.pull;
  right.slack = Real(1) / right.pull;
}

/// Loads of both strands, and how easily their weight bends them.
template <class Push, class Real>
void shareLoad(const Machine<Real>& machine, Push push, Hanging<Real>& hanging) {
  Strand<Real>& left = hanging.strand[kLeft];
  Strand<Real>& right = hanging.strand[kRight];
  hanging.sine_of_sum = left.sine * right.cosine + left.cosine * right.sine;
  pull(loadOf(machine, hanging.strand) / hanging.sine_of_sum, push, left, right);
  left.bend = left.cosine * left.slack;
  right.bend = right.cosine * right.slack;
  left.deep = right.deep = machine.deep;
  if (!machine.deep) return;
  // Second-order sag needs these too: see deep.h.
  left.lean = left.sine * left.slack;
  right.lean = right.sine * right.slack;
  left.ease = right.ease =
      machine.ease * (left.free * left.free * left.lean + right.free * right.free * right.lean);
}

/// The nearest place where slopes exist: below the motors and between them.
template <class Real>
Point<Real> insideReach(const Machine<Real>& machine, Point<Real> place) {
  return {clamp(place.x, machine.leftmost, machine.rightmost),
          clamp(place.y, machine.lowest, machine.highest)};
}

/// Adds a step to a place, cut short where the slopes no longer apply.
template <class Real>
Point<Real> stepFrom(const Machine<Real>& machine, Point<Real> place, Point<Real> step) {
  const Real most = Real(kLongestStep);
  return insideReach(machine, Point<Real>{place.x + clamp(step.x, -most, most),
                                          place.y + clamp(step.y, -most, most)});
}

/// True where both parts of a step are shorter than `length`.
template <class Real>
bool isShort(Point<Real> step, float length) {
  return isWithin(step.x, length) && isWithin(step.y, length);
}

/// Whether the chains, laid straight from sprocket to sprocket, reach each other at all.
template <class Real>
bool canMeet(const Machine<Real>& machine, Chains<Real> chains) {
  const Real arm = machine.frame.rotation_radius;
  return canMeet(chains, arm + arm, machine.frame.motor_gap);
}

/// Where two straight chains meet whose wrap is that of a 45 degree strand.
template <class Real>
Point<Real> meetStraight(const Machine<Real>& machine, Chains<Real> chains) {
  const Real more = machine.rotation_radius - machine.wrap.middle;
  const Point<Real> from = machine.sprocket[kLeft];
  const Point<Real> span = meet(chains.left + more, chains.right + more, machine.frame.motor_gap);
  return {from.x + span.x, from.y - span.y};
}

/// Forces of two strands on sprockets and sled under a load, without a push.
template <class Real>
PLUMB_INLINE Forces<Real> forcesOf(Real load, NoPush, const Strand<Real>& left,
                                   const Strand<Real>& right) {
  const Real to_left = left.sine * right.cosine;
  const Real to_right = left.cosine * right.sine;
  const Real scale = load / (to_left + to_right);
  return {scale * (left.cosine * right.cosine), {scale * to_left, scale * to_right}};
}

/// Forces of two strands on sprockets and sled under a load and a push.
template <class Real>
PushedForces<Real> forcesOf(Real load, Point<Real> push, Strand<Real> left, Strand<Real> right) {
  pull(load / (left.sine * right.cosine + left.cosine * right.sine), push, left, right);
  return {{left.pull * left.cosine, right.pull * right.cosine},
          {left.pull * left.sine, right.pull * right.sine}};
}

/// By how much effects move the ends of each strand [mm]. The forces are those of strands between
/// ends that have not moved.
template <class Push, class Real>
PLUMB_RARE void spanBetweenEnds(const Machine<Real>& machine, Point<Real> bit, Push push,
                                Point<Real>* span) {
  Strand<Real> strand[kSideCount];
  for (uint8_t side = kLeft; side < kSideCount; ++side) {
    const Point<Real> sprocket = machine.sprocket[side];
    const Real run = side == kLeft ? bit.x - sprocket.x : sprocket.x - bit.x;
    const Real drop = sprocket.y - bit.y;
    const Real distance = sqrt(run * run + drop * drop + machine.radius_squared);
    direct(machine, run, drop, distance, strand[side]);
  }
  const auto forces = forcesOf(loadOf(machine, strand), push, strand[kLeft], strand[kRight]);
  span[kLeft] = span[kRight] = {Real(0), Real(0)};
  Effects::For<Real>::moveEnds(machine.coefficient, machine.present, strand, forces, span);
}

template <class Push, class Real>
PLUMB_INLINE Hanging<Real> hangUnder(const Machine<Real>& machine, const Point<Real>& bit,
                                     bool directed, Push push) {
  Hanging<Real> hanging;
  typedef Effects::For<Real> All;
  Point<Real> room[kSideCount];
  const Point<Real>* span = nullptr;
  if (machine.present & All::kMoveMask) {
    spanBetweenEnds(machine, bit, push, room);
    span = room;
  }
  drawBoth(machine, bit, span, directed || machine.forces, hanging);
  if (directed || machine.forces) shareLoad(machine, push, hanging);
  if (machine.present == 0) return hanging;
  for (uint8_t side = kLeft; side < kSideCount; ++side)
    All::adjustLength(machine.coefficient, machine.present, hanging.strand[side]);
  return hanging;
}

/// The push of all effects at a place.
template <class Real>
Point<Real> pushAt(const Machine<Real>& machine, Point<Real> bit) {
  Point<Real> push = {Real(0), Real(0)};
  Effects::For<Real>::pushSled(machine.coefficient, machine.present, bit, push);
  return push;
}

/// Whether an effect of the list pushes the sled. If none does, the board has no code for pushes.
template <bool kPushed>
struct Pushed {};

template <class Real>
PLUMB_INLINE NoPush pushOf(Pushed<false>, const Machine<Real>&, const Point<Real>&) {
  return NoPush();
}

template <class Real>
Point<Real> pushOf(Pushed<true>, const Machine<Real>& machine, Point<Real> bit) {
  return pushAt(machine, bit);
}

}  // namespace

template <class Real>
Machine<Real> prepare(const Frame<Real>& frame, const EffectParams<Real>& effects) {
  Machine<Real> machine;
  machine.frame = frame;
  const Real half_gap = frame.motor_gap * Real(0.5);
  machine.sprocket[kLeft] = {frame.motor_center_x - half_gap, frame.motor_height};
  machine.sprocket[kRight] = {frame.motor_center_x + half_gap, frame.motor_height};
  machine.feed_radius = feedRadius(frame);
  machine.radius_squared = frame.sprocket_radius * frame.sprocket_radius;
  machine.wrap = wrapOf(frame, kArc);
  machine.rotation_radius = frame.rotation_radius;
  // The sled carries free / reach of half a chain's weight: half the weight of free^2 / reach mm.
  // That length is free - radius + radius^2 / reach. The last term is small, so it is taken at a
  // medium reach.
  const Real half_ratio = frame.chain_weight / frame.sled_weight * Real(0.5);
  const Real lever =
      frame.rotation_radius * (frame.rotation_radius / (frame.motor_gap * Real(0.64)) - Real(1));
  machine.load_slope = half_ratio;
  machine.load_at_nothing = Real(1) + half_ratio * (lever + lever);
  // Nearer to the line of the motors the chains would carry many times the sled's weight. Farther
  // below it than the ring's radius there is free chain on both sides.
  const Real margin = frame.motor_gap * Real(kFlattest);
  machine.highest = frame.motor_height - frame.rotation_radius - frame.sprocket_radius - margin;
  machine.lowest = frame.motor_height - Real(4) * frame.motor_gap;
  machine.leftmost = machine.sprocket[kLeft].x + margin;
  machine.rightmost = machine.sprocket[kRight].x - margin;
  machine.deep = isDeep(frame);
  machine.ease = easeOf(frame);
  typedef Effects::For<Real> All;
  machine.present = All::presentMask(effects.value);
  machine.forces = (machine.present & All::kForceMask) != 0;
  All::prepare(frame, effects.value, machine.coefficient);
  All::moveSprocket(machine.coefficient, machine.present, machine.sprocket);
  machine.level = isZero(machine.sprocket[kRight].y - machine.sprocket[kLeft].y);
  return machine;
}

template <class Real>
Hanging<Real> hang(const Machine<Real>& machine, Point<Real> bit, bool directed) {
  typedef Pushed<Effects::For<Real>::kPushMask != 0> IsPushed;
  return hangUnder(machine, bit, directed, pushOf(IsPushed(), machine, bit));
}

template <class Real>
PaidOut<Real> inverse(const Machine<Real>& machine, Point<Real> bit) {
  const Hanging<Real> hanging = hang(machine, bit, false);
  const Chains<Real> chains = paidOut(hanging);
  // A place that is NaN, or too far away for a float, ends here.
  if (hanging.found == Found::kYes && isfinite(chains.left) && isfinite(chains.right))
    return {chains, Found::kYes};
  return {{Real(0), Real(0)}, Found::kOutOfReach};
}

template <class Real>
Place<Real> forward(const Machine<Real>& machine, Chains<Real> chains, Point<Real> guess) {
  Place<Real> place = {guess, Found::kOutOfReach, 0};
  if (!canMeet(machine, chains)) return place;
  place.sled = insideReach(machine, guess);
  for (place.tries = 1; place.tries <= kMostTries; ++place.tries) {
    const Hanging<Real> hanging = hang(machine, place.sled, true);
    const Chains<Real> now = paidOut(hanging);
    const Point<Real> step =
        stepOf(hanging.strand[kLeft], hanging.strand[kRight], hanging.sine_of_sum,
               chains.left - now.left, chains.right - now.right);
    const Point<Real> next = {place.sled.x + step.x, place.sled.y + step.y};
    if (isShort(step, kLastStep)) return {next, hanging.found, place.tries};
    place.sled = isShort(step, kSafeStep) ? next : stepFrom(machine, place.sled, step);
  }
  // The search ended at the edge of where a sled can hang: the place asked for lies beyond it.
  const bool held = !(place.sled.x > machine.leftmost && place.sled.x < machine.rightmost &&
                      place.sled.y > machine.lowest && place.sled.y < machine.highest);
  place.found = held ? Found::kOutOfReach : Found::kTooManyTries;
  return place;
}

template <class Real>
Place<Real> forward(const Machine<Real>& machine, Chains<Real> chains) {
  return forward(machine, chains, meetStraight(machine, chains));
}

template Machine<float> prepare(const Frame<float>&, const EffectParams<float>&);
template Hanging<float> hang(const Machine<float>&, Point<float>, bool);
template PaidOut<float> inverse(const Machine<float>&, Point<float>);
template Place<float> forward(const Machine<float>&, Chains<float>);
template Place<float> forward(const Machine<float>&, Chains<float>, Point<float>);

// For the lab; the linker drops it from the firmware, which never calls it.
template Machine<double> prepare(const Frame<double>&, const EffectParams<double>&);
template Hanging<double> hang(const Machine<double>&, Point<double>, bool);
template PaidOut<double> inverse(const Machine<double>&, Point<double>);
template Place<double> forward(const Machine<double>&, Chains<double>);
template Place<double> forward(const Machine<double>&, Chains<double>, Point<double>);

}  // namespace kinematics
