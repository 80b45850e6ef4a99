// The older sled: two chains end at two brackets of a rigid body, which tilts until it balances.
// Left out: every effect but pitch. Sag and stretch would move the usual sled by up to 8.5 mm.
#pragma once

#include "Kinematics.h"

namespace kinematics {

/// Where chains and weight act on a sled with two brackets, while it hangs level.
///
/// Its brackets must be above its centre of gravity; else it can hang nowhere.
template <class Real>
struct BracketSled {
  Real mount_gap;     ///< [mm] between the brackets, as far left of the bit as right of it
  Real mount_height;  ///< [mm] brackets above the bit
  Real center_depth;  ///< [mm] centre of gravity below the bit
};

/// By how much the links of each chain are longer than nominal.
template <class Real>
struct PitchStrain {
  Real left, right;  ///< [1]
};

/// The strains among a machine's effect parameters. No other effect counts here. parameter(i) is
/// the i-th of all parameters.
template <class Real, class Parameter>
PitchStrain<Real> pitchAmong(Parameter parameter) {
  typedef ChainPitch<Real> Pitch;
  const uint8_t first = Effects::For<Real>::template firstOf<Pitch>();
  return {parameter(uint8_t(first + Pitch::kLeftStrain)),
          parameter(uint8_t(first + Pitch::kRightStrain))};
}

/// A machine with such a sled, ready for computing. prepare() makes it.
template <class Real>
struct Quadrilateral {
  Real half_gap;                      ///< [mm] bit to either bracket, while level
  Real mount_height;                  ///< [mm] as in the sled
  Real center_depth;                  ///< [mm] as in the sled
  Real center[kSideCount], height;    ///< [mm] x and y of the sprockets' centres
  Real feed_radius;                   ///< [mm] sprocket's, negative off the bottom
  Real radius_squared;                ///< [mm^2] of the sprocket
  Wrap<Real> wrap;                    ///< by kTiltedArc in quadrilateral.cpp
  Real links[kSideCount];             ///< [1] nominal length of chain per length
  Real steepest;                      ///< [1] tilt_sine of the most tilted sled
  Real rough_drop;                    ///< [mm] see roughTilt in quadrilateral.cpp
  Real highest, leftmost, rightmost;  ///< [mm] below and between these a bit can hang
  Real lowest;                        ///< [mm] forward() searches down to here
};

/// Chain lengths for a place of the bit; lengths are zero unless `found` is kYes.
///
/// A tilt is given by its sine, counterclockwise. The tilt of a place is a good guess for the next
/// place. Use it only if `found` is kYes.
template <class Real>
struct TiltedPaidOut {
  Chains<Real> chains;  ///< [mm] from 12 o'clock
  Real tilt_sine;       ///< [1]
  Found found;
  uint8_t tries;  ///< iterations it took
};

/// The sled's place and tilt. Use them only if `found` is kYes.
template <class Real>
struct TiltedPlace {
  Point<Real> sled;  ///< [mm] where the bit is
  Real tilt_sine;    ///< [1]
  Found found;
  uint8_t tries;  ///< iterations it took
};

/// Works out the constants of a machine. The frame's ring and weights play no part: on chains
/// without weight a heavy sled hangs where a light sled hangs.
template <class Real>
Quadrilateral<Real> prepare(const Frame<Real>& frame, const BracketSled<Real>& sled,
                            const PitchStrain<Real>& pitch);

/// Chain to pay out on each side, from 12 o'clock, so that the bit is at `bit` [mm].
template <class Real>
TiltedPaidOut<Real> inverse(const Quadrilateral<Real>& machine, Point<Real> bit);

/// Chain to pay out, with the tilt of a place nearby as guess: half the work. A bad guess costs
/// only iterations.
template <class Real>
TiltedPaidOut<Real> inverse(const Quadrilateral<Real>& machine, Point<Real> bit, Real tilt_sine);

/// Where the bit is when `chains` [mm] are paid out.
template <class Real>
TiltedPlace<Real> forward(const Quadrilateral<Real>& machine, Chains<Real> chains);

/// Where the bit is, from a place `guess` [mm] and the sled's tilt there: for following the
/// encoders.
template <class Real>
TiltedPlace<Real> forward(const Quadrilateral<Real>& machine, Chains<Real> chains,
                          Point<Real> guess, Real tilt_sine);

}  // namespace kinematics
