// The library's front door: where the sled hangs, and how much chain holds it there.
#pragma once

#include "machine.h"

namespace kinematics {

/// How a search or a request ended.
enum class Found : uint8_t {
  kYes,
  kOutOfReach,    ///< no sled can hang there: outside or above the motors, inside a sprocket, NaN,
                  ///< or chains too short to meet
  kTooManyTries,  ///< the search did not settle; do not use its place
};

/// Answer of inverse(): lengths are zero unless `found` is kYes.
template <class Real>
struct PaidOut {
  Chains<Real> chains;  ///< [mm] from 12 o'clock
  Found found;
};

/// Answer of forward(). Use the place only if `found` is kYes.
template <class Real>
struct Place {
  Point<Real> sled;  ///< [mm] where the bit is
  Found found;
  uint8_t tries;  ///< iterations it took
};

/// Both strands of a hanging sled.
template <class Real>
struct Hanging {
  Found found;       ///< never kYes above the motors or outside them; a NaN shows in the lengths
  Real sine_of_sum;  ///< [1] of both strands' angles below the horizontal added together
  Strand<Real> strand[kSideCount];
};

/// Works out the constants of a machine: about 6,000 cycles on the board, each time settings
/// change.
template <class Real>
Machine<Real> prepare(const Frame<Real>& frame, const EffectParams<Real>& effects);

/// Both strands for a bit at `bit` [mm]. Directions and forces are worked out if `directed` or if
/// an effect needs them.
template <class Real>
Hanging<Real> hang(const Machine<Real>& machine, Point<Real> bit, bool directed);

/// Chain of both strands [mm] from 12 o'clock.
template <class Real>
Chains<Real> paidOut(const Hanging<Real>& hanging) {
  return {hanging.strand[kLeft].wrap + hanging.strand[kLeft].length,
          hanging.strand[kRight].wrap + hanging.strand[kRight].length};
}

/// Chain to pay out on each side, from 12 o'clock, so that the bit is at `bit` [mm].
template <class Real>
PaidOut<Real> inverse(const Machine<Real>& machine, Point<Real> bit);

/// Where the bit is when `chains` [mm] are paid out, searched from the straight-chain solution.
template <class Real>
Place<Real> forward(const Machine<Real>& machine, Chains<Real> chains);

/// Where the bit is, searched from a place `guess` [mm] nearby: for following the encoders.
template <class Real>
Place<Real> forward(const Machine<Real>& machine, Chains<Real> chains, Point<Real> guess);

}  // namespace kinematics
