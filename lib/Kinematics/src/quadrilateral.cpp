// Inverse and forward kinematics of the sled with two brackets, both by a search for its tilt.
//
// A strand is the line that touches the sprocket and passes through the bracket. Sine and cosine
// are those of its angle below the horizontal. A prime (') marks the right side. For a unit pull
// along a strand,
//   lever = its moment about the bit: counterclockwise on the left, clockwise on the right,
//   along = the part of the line from bit to bracket that lies along the strand.
// Two pulls and a weight balance, sideways and upright, when
//   pull = weight cosine' / sine_of_sum,  pull' = weight cosine / sine_of_sum,
// so balanced moments about the bit mean, times sine_of_sum / weight,
//   moment = cosine' lever - cosine lever' - center_depth sin(tilt) sine_of_sum = 0.
// Newton's method needs the slope of that moment. Per radian that the sled turns counterclockwise
// about the bit,
//   lever changes by -along, length by -lever (right: lever', length' by +along', +lever'),
//   the left strand gets steeper by along / free, the right strand flatter by along' / free'.
// Per radian that the left strand gets steeper, the moment falls by
//   cosine' along - sine lever' + center_depth sin(tilt) cosine_of_sum
// (right: it grows, with the signs of lever and center_depth changed).
// The chains' slopes along x and y are the strands' directions, so the same numbers give the
// forward search its slopes: place and tilt change together until lengths and moment are right.
#include "quadrilateral.h"

#include <math.h>

#include "search.h"

namespace kinematics {

namespace {

// Wrap is radius * angle, and angle = pi/4 + asin((sine - cosine) / sqrt(2)). From level to
// upright these odd coefficients give it within 0.00016 rad: 0.0016 mm. The coefficients for a sled
// on a ring are closer over a narrower range: a chain on a ring never hangs as steep.
const double kTiltedArc[3] = {0.70818114, 0.05135919, 0.02569482};

// A chain pulls with at most weight / sine_of_sum, so this keeps tensions within what chains stand.
const float kLeastSine = 1.0f / 32;

// After a last step as long as this, what the first order misses is 0.0005 mm of chain.
const float kLastTurn = 0.002f;   // [rad]
const float kLongestTurn = 0.3f;  // [rad]
// A guess from which the first step is longer than this is dropped; the search starts without it.
const float kNearStep = 100.0f;  // [mm]
const float kNearTurn = 0.2f;    // [rad]

const float kRoughSine = 0.4f;  // sine = tangent - 0.4 tangent^3 for the tilts that occur

/// A chain at its bracket. The top of this file defines lever and along.
template <class Real>
struct Held {
  Real free;          // [mm] between sprocket and bracket
  Real sine, cosine;  // [1] of the strand below the horizontal
  Real per_free;      // [1/mm] turn of the strand per mm of bracket across it: about 1 / free
  Real lever, along;  // [mm]
};

/// A sled at some place and tilt, whether or not it would stay there.
template <class Real>
struct Balance {
  Held<Real> left, right;
  Real sine_of_sum, cosine_of_sum;  // [1] of both angles
  Real tilt_cosine;                 // [1]
  Real moment;                      // [mm] moment about the bit / weight * sine_of_sum
  Real slope;                       // [mm] moment per rad of tilt about a bit that stays
  Real left_turned, right_turned;   // [1] moment per mm of a bracket across its strand
};

/// A strand to a bracket `run` [mm] inwards of its sprocket and `drop` [mm] below it. The bracket
/// is `out` [mm] from the bit towards the strand's side, and `up` [mm] above it.
template <class Real>
void hold(const Quadrilateral<Real>& machine, Real run, Real drop, Real out, Real up,
          Held<Real>& held) {
  const Real reach_squared = run * run + drop * drop;
  held.free = sqrt(reach_squared - machine.radius_squared);
  const Real per_square = Real(1) / reach_squared;
  // Sprocket's centre, tangent point and bracket make a right-angled triangle. Only slopes need
  // 1 / free, and they can bear that this value is too small by (radius / reach)^2.
  held.per_free = held.free * per_square;
  const Real lift = machine.feed_radius * per_square;
  held.sine = drop * held.per_free + run * lift;
  held.cosine = run * held.per_free - drop * lift;
  held.lever = up * held.cosine - out * held.sine;
  held.along = out * held.cosine + up * held.sine;
}

/// Moment, and its changes, of two strands and a weight that acts `below` [mm] the bit and `aside`
/// [mm] to its right.
template <class Real>
void weigh(Real aside, Real below, Balance<Real>& balance) {
  const Held<Real>& left = balance.left;
  const Held<Real>& right = balance.right;
  const Real sum = left.sine * right.cosine + left.cosine * right.sine;
  const Real cosine_of_sum = left.cosine * right.cosine - left.sine * right.sine;
  balance.sine_of_sum = sum;
  balance.cosine_of_sum = cosine_of_sum;
  balance.moment = right.cosine * left.lever - left.cosine * right.lever - aside * sum;
  const Real left_along = right.cosine * left.along;
  const Real right_along = left.cosine * right.along;
  const Real lost = aside * cosine_of_sum;
  balance.left_turned = (left_along - left.sine * right.lever + lost) * left.per_free;
  balance.right_turned = (right_along - right.sine * left.lever - lost) * right.per_free;
  balance.slope = -(left_along + right_along + below * sum + left.along * balance.left_turned +
                    right.along * balance.right_turned);
}

/// Both strands and the balance of a sled at a place and tilt.
template <class Real>
Balance<Real> balanceAt(const Quadrilateral<Real>& machine, Point<Real> bit, Real tilt_sine) {
  Balance<Real> balance;
  const Real cosine = sqrt(Real(1) - tilt_sine * tilt_sine);
  balance.tilt_cosine = cosine;
  const Real out = machine.half_gap * cosine, rise = machine.half_gap * tilt_sine;
  const Real up = machine.mount_height * cosine, lean = machine.mount_height * tilt_sine;
  const Real drop = machine.height - bit.y;
  const Real left_out = out + lean, left_up = up - rise;
  hold(machine, bit.x - machine.center[kLeft] - left_out, drop - left_up, left_out, left_up,
       balance.left);
  const Real right_out = out - lean, right_up = up + rise;
  hold(machine, machine.center[kRight] - bit.x - right_out, drop - right_up, right_out, right_up,
       balance.right);
  weigh(machine.center_depth * tilt_sine, machine.center_depth * cosine, balance);
  return balance;
}

/// Limits a tilt to what a sled at rest can have.
template <class Real>
Real clampedTilt(const Quadrilateral<Real>& machine, Real tilt_sine) {
  return clamp(tilt_sine, -machine.steepest, machine.steepest);
}

/// The tilt after a long turn [rad].
template <class Real>
Real turnedFar(const Quadrilateral<Real>& machine, Real tilt_sine, Real tilt_cosine, Real turn) {
  const Real some = clamp(turn, Real(-kLongestTurn), Real(kLongestTurn));
  return clampedTilt(machine, tilt_sine + some * (tilt_cosine - some * tilt_sine * Real(0.5)));
}

/// A tilt for the search to start from: the tilt for a level sled's strands, drawn to the
/// sprockets' centres. With the runs and the drop of its brackets, tan(tilt) =
/// half_gap drop (run - run') / ((height + depth) drop (run + run') + 2 half_gap run run').
template <class Real>
Real roughTilt(const Quadrilateral<Real>& machine, Point<Real> bit) {
  const Real left = bit.x - machine.center[kLeft] - machine.half_gap;
  const Real right = machine.center[kRight] - bit.x - machine.half_gap;
  const Real drop = machine.height - bit.y - machine.mount_height;
  const Real tangent = drop * (left - right) / (machine.rough_drop * drop + Real(2) * left * right);
  return clampedTilt(machine, tangent * (Real(1) - Real(kRoughSine) * tangent * tangent));
}

/// [mm] chain from 12 o'clock to a bracket, in nominal links.
template <class Real>
Real paidOut(const Quadrilateral<Real>& machine, Side side, const Held<Real>& held) {
  return machine.wrap.at(held.sine - held.cosine) + machine.links[side] * held.free;
}

/// Whether both chains lead down and inwards, so that both pull, and neither far too much.
template <class Real>
bool bothPull(const Balance<Real>& balance) {
  return !signbit(balance.left.sine) && !signbit(balance.left.cosine) &&
         !signbit(balance.right.sine) && !signbit(balance.right.cosine) &&
         balance.sine_of_sum > Real(kLeastSine);
}

/// Where a bit can hang at all; false for NaN.
template <class Real>
bool isBelowMotors(const Quadrilateral<Real>& machine, Point<Real> bit) {
  return bit.x > machine.leftmost && bit.x < machine.rightmost && bit.y < machine.highest;
}

template <class Real>
Point<Real> keptWithin(const Quadrilateral<Real>& machine, Point<Real> bit) {
  return {clamp(bit.x, machine.leftmost, machine.rightmost),
          clamp(bit.y, machine.lowest, machine.highest)};
}

/// Whether the chains, laid straight from sprocket to sprocket, reach each other's bracket at all.
template <class Real>
bool canMeet(const Quadrilateral<Real>& machine, Chains<Real> chains) {
  const Real gap = machine.center[kRight] - machine.center[kLeft];
  return canMeet(chains, machine.half_gap + machine.half_gap, gap);
}

/// One Newton step of the forward search.
template <class Real>
struct Motion {
  Point<Real> step;  // [mm]
  Real turn;         // [rad]
};

/// The step that makes up for both errors [mm] and the moment at once. With the chains held, each
/// radian of turn moves the bit as errors of lever and -lever' would.
template <class Real>
Motion<Real> motionTowards(const Balance<Real>& balance, Real left_error, Real right_error) {
  const Held<Real>& left = balance.left;
  const Held<Real>& right = balance.right;
  const Real sum = balance.sine_of_sum;
  const Real by_left = balance.right_turned - balance.left_turned * balance.cosine_of_sum;
  const Real by_right = balance.left_turned - balance.right_turned * balance.cosine_of_sum;
  const Real slope = sum * balance.slope + by_left * left.lever + by_right * right.lever;
  Motion<Real> motion;
  motion.turn =
      clamp((by_right * right_error - by_left * left_error - sum * balance.moment) / slope,
            Real(-kLongestTurn), Real(kLongestTurn));  // a NaN is a long turn
  left_error += left.lever * motion.turn;
  right_error -= right.lever * motion.turn;
  motion.step = stepOf(left, right, sum, left_error, right_error);
  return motion;
}

/// A place to start from without a guess: a level sled on straight chains that have the wrap of a
/// 45 degree strand.
template <class Real>
void startLevel(const Quadrilateral<Real>& machine, Chains<Real> chains, TiltedPlace<Real>& place) {
  const Real from = machine.center[kLeft] + machine.half_gap;
  const Real gap = machine.center[kRight] - machine.half_gap - from;
  const Point<Real> span =
      meet(chains.left - machine.wrap.middle, chains.right - machine.wrap.middle, gap);
  const Real height = machine.height - machine.mount_height;
  place.sled = keptWithin(machine, Point<Real>{from + span.x, height - span.y});
  place.tilt_sine = roughTilt(machine, place.sled);
}

/// Moves a place by a step that may be long.
template <class Real>
void moveFar(const Quadrilateral<Real>& machine, const Motion<Real>& motion, Real tilt_cosine,
             TiltedPlace<Real>& place) {
  const Real most = Real(kLongestStep);
  const Point<Real> next = {place.sled.x + clamp(motion.step.x, -most, most),
                            place.sled.y + clamp(motion.step.y, -most, most)};
  place.sled = keptWithin(machine, next);
  place.tilt_sine = turnedFar(machine, place.tilt_sine, tilt_cosine, motion.turn);
}

/// True where a step stays below a length [mm] and a turn [rad].
template <class Real>
bool isShort(const Motion<Real>& motion, float step, float turn) {
  return isWithin(motion.turn, turn) && isWithin(motion.step.x, step) &&
         isWithin(motion.step.y, step);
}

/// Searches from a place. A place that was `guessed` and turns out to be far off is replaced by a
/// better start.
template <class Real>
void search(const Quadrilateral<Real>& machine, Chains<Real> chains, bool guessed,
            TiltedPlace<Real>& place) {
  for (place.tries = 1; place.tries <= kMostTries; ++place.tries) {
    const Balance<Real> balance = balanceAt(machine, place.sled, place.tilt_sine);
    const Motion<Real> motion =
        motionTowards(balance, chains.left - paidOut(machine, kLeft, balance.left),
                      chains.right - paidOut(machine, kRight, balance.right));
    if (isShort(motion, kLastStep, kLastTurn)) {
      place.sled = {place.sled.x + motion.step.x, place.sled.y + motion.step.y};
      place.tilt_sine += motion.turn * balance.tilt_cosine;
      if (bothPull(balance)) place.found = Found::kYes;
      return;
    }
    if (guessed && !isShort(motion, kNearStep, kNearTurn))
      startLevel(machine, chains, place);
    else
      moveFar(machine, motion, balance.tilt_cosine, place);
    guessed = false;
  }
  // The search ended at the edge of where a sled can hang: the place asked for lies beyond it.
  place.tries = kMostTries;
  if (isBelowMotors(machine, place.sled) && place.sled.y > machine.lowest)
    place.found = Found::kTooManyTries;
}

}  // namespace

template <class Real>
Quadrilateral<Real> prepare(const Frame<Real>& frame, const BracketSled<Real>& sled,
                            const PitchStrain<Real>& pitch) {
  Quadrilateral<Real> machine;
  const Real half_frame = frame.motor_gap * Real(0.5);
  machine.center[kLeft] = frame.motor_center_x - half_frame;
  machine.center[kRight] = frame.motor_center_x + half_frame;
  machine.feed_radius = feedRadius(frame);
  machine.radius_squared = frame.sprocket_radius * frame.sprocket_radius;
  machine.wrap = wrapOf(frame, kTiltedArc);
  machine.links[kLeft] = Real(1) / (Real(1) + pitch.left);
  machine.links[kRight] = Real(1) / (Real(1) + pitch.right);
  const Real half_gap = sled.mount_gap * Real(0.5);
  const Real above = sled.mount_height + sled.center_depth;
  // Any other sled would topple instead of tilting: it can hang nowhere.
  machine.height = half_gap > Real(0) && above > Real(0) ? frame.motor_height : Real(NAN);
  machine.half_gap = half_gap;
  machine.mount_height = sled.mount_height;
  machine.center_depth = sled.center_depth;
  machine.rough_drop = above * (frame.motor_gap - sled.mount_gap) / half_gap;
  // A sled on a single chain tilts more than any other balanced sled: its centre of gravity is
  // right below its bracket.
  const Real arm = sqrt(half_gap * half_gap + above * above);
  machine.steepest = half_gap / arm;
  // That single chain is upright, so the bit is this far inwards of its sprocket.
  const Real inwards = half_gap * sled.center_depth / arm;
  machine.leftmost = machine.center[kLeft] + inwards;
  machine.rightmost = machine.center[kRight] - inwards;
  machine.highest = machine.height - sled.mount_height;
  machine.lowest = frame.motor_height - Real(4) * frame.motor_gap;
  return machine;
}

template <class Real>
TiltedPaidOut<Real> inverse(const Quadrilateral<Real>& machine, Point<Real> bit, Real tilt_sine) {
  TiltedPaidOut<Real> paid = {{Real(0), Real(0)}, tilt_sine, Found::kOutOfReach, 1};
  for (; paid.tries <= kMostTries; ++paid.tries) {
    const Balance<Real> balance = balanceAt(machine, bit, paid.tilt_sine);
    // The moment falls as the tilt grows. Where it does not, close below a motor, its sign still
    // says which way to turn.
    const Real turn = balance.moment / fabs(balance.slope);
    if (isWithin(turn, kLastTurn)) {
      if (!bothPull(balance)) return paid;
      paid.chains = {paidOut(machine, kLeft, balance.left) - balance.left.lever * turn,
                     paidOut(machine, kRight, balance.right) + balance.right.lever * turn};
      paid.tilt_sine += turn * balance.tilt_cosine;
      paid.found = Found::kYes;
      return paid;
    }
    if (!isBelowMotors(machine, bit)) return paid;
    paid.tilt_sine = turnedFar(machine, paid.tilt_sine, balance.tilt_cosine, turn);
  }
  // Near the edge of its reach a sled wants to tilt more than any sled at rest.
  paid.tries = kMostTries;
  if (fabs(paid.tilt_sine) < machine.steepest) paid.found = Found::kTooManyTries;
  return paid;
}

template <class Real>
TiltedPaidOut<Real> inverse(const Quadrilateral<Real>& machine, Point<Real> bit) {
  return inverse(machine, bit, roughTilt(machine, bit));
}

template <class Real>
TiltedPlace<Real> forward(const Quadrilateral<Real>& machine, Chains<Real> chains,
                          Point<Real> guess, Real tilt_sine) {
  TiltedPlace<Real> place = {guess, tilt_sine, Found::kOutOfReach, 0};
  if (canMeet(machine, chains)) search(machine, chains, true, place);
  return place;
}

template <class Real>
TiltedPlace<Real> forward(const Quadrilateral<Real>& machine, Chains<Real> chains) {
  TiltedPlace<Real> place = {{Real(0), Real(0)}, Real(0), Found::kOutOfReach, 0};
  if (!canMeet(machine, chains)) return place;
  startLevel(machine, chains, place);
  search(machine, chains, false, place);
  return place;
}

template Quadrilateral<float> prepare(const Frame<float>&, const BracketSled<float>&,
                                      const PitchStrain<float>&);
template TiltedPaidOut<float> inverse(const Quadrilateral<float>&, Point<float>);
template TiltedPaidOut<float> inverse(const Quadrilateral<float>&, Point<float>, float);
template TiltedPlace<float> forward(const Quadrilateral<float>&, Chains<float>);
template TiltedPlace<float> forward(const Quadrilateral<float>&, Chains<float>, Point<float>,
                                    float);

// For the lab; the linker drops it from the firmware, which never calls it.
template Quadrilateral<double> prepare(const Frame<double>&, const BracketSled<double>&,
                                       const PitchStrain<double>&);
template TiltedPaidOut<double> inverse(const Quadrilateral<double>&, Point<double>);
template TiltedPaidOut<double> inverse(const Quadrilateral<double>&, Point<double>, double);
template TiltedPlace<double> forward(const Quadrilateral<double>&, Chains<double>);
template TiltedPlace<double> forward(const Quadrilateral<double>&, Chains<double>, Point<double>,
                                     double);

}  // namespace kinematics
