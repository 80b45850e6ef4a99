// The older sled: two chains end at two brackets of one rigid body, which tilts until it balances.
// Left out: every effect but pitch. Sag and stretch would move the usual sled by up to 8.5 mm.
#pragma once

#include "Kinematics.h"

namespace kinematics {

/// Where chains and weight act on a sled with two brackets, while it hangs level.
///
/// Its brackets must be above its centre of gravity, or nowhere is in its reach.
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

/// Their part of a machine's effects: the only one that counts here. parameter(i) is the i-th of
/// all.
template <class Real, class Parameter>
PitchStrain<Real> pitchAmong(Parameter parameter) {
  typedef ChainPitch<Real> Pitch;
  const uint8_t first = Effects::For<Real>::template firstOf<Pitch>();
  return {parameter(uint8_t(first + Pitch::kLeftStrain)),
          parameter(uint8_t(first + Pitch::kRightStrain))};
}

/// A machine with such a sled, made ready for computing. Made by prepare().
template <class Real>
struct Quadrilateral {
  Real half_gap;                      ///< [mm] bit to either bracket, while level
  Real mount_height;                  ///< [mm] as in the sled
  Real center_depth;                  ///< [mm] as in the sled
  Real center[kSideCount], height;    ///< [mm] x and y of the sprockets' centres
  Real feed_radius;                   ///< [mm] sprocket's, negative off the bottom
  Real radius_squared;                ///< [mm^2] of the sprocket
  Wrap<Real> wrap;                    ///< by kArc in quadrilateral.cpp
  Real links[kSideCount];             ///< [1] nominal length of chain per length
  Real steepest;                      ///< [1] tilt_sine of the most tilted sled
  Real rough_drop;                    ///< [mm] see roughTilt in quadrilateral.cpp
  Real highest, leftmost, rightmost;  ///< [mm] below and between these a bit can hang
  Real lowest;                        ///< [mm] forward() searches down to here
};

/// Chain lengths for a place of the bit; lengths are zero unless found is kYes.
///
/// Tilts are told by their sine, counterclockwise; that of one place is a good guess for the next.
/// It means nothing unless found is kYes.
template <class Real>
struct TiltedPaidOut {
  Chains<Real> chains;  ///< [mm] from 12 o'clock
  Real tilt_sine;       ///< [1]
  Found found;
  uint8_t tries;  ///< rounds it took
};

/// The sled's place and tilt, to be used only if found is kYes.
template <class Real>
struct TiltedPlace {
  Point<Real> sled;  ///< [mm] where the bit is
  Real tilt_sine;    ///< [1]
  Found found;
  uint8_t tries;  ///< rounds it took
};

/// Works out the constants of a machine. The frame's ring and weights play no part: chains without
/// weight hold a heavy sled where they hold a light one.
template <class Real>
Quadrilateral<Real> prepare(const Frame<Real>& frame, const BracketSled<Real>& sled,
                            const PitchStrain<Real>& pitch);

/// Chain to pay out on each side, from 12 o'clock, so that the bit is at `bit` [mm].
template <class Real>
TiltedPaidOut<Real> inverse(const Quadrilateral<Real>& machine, Point<Real> bit);

/// The same from the tilt of a place nearby: half the work. A bad guess costs rounds, no more.
template <class Real>
TiltedPaidOut<Real> inverse(const Quadrilateral<Real>& machine, Point<Real> bit, Real tilt_sine);

/// Where the bit is when `chains` [mm] are paid out.
template <class Real>
TiltedPlace<Real> forward(const Quadrilateral<Real>& machine, Chains<Real> chains);

/// The same from a place `guess` [mm] and the sled's tilt there, as when following the encoders.
template <class Real>
TiltedPlace<Real> forward(const Quadrilateral<Real>& machine, Chains<Real> chains,
                          Point<Real> guess, Real tilt_sine);

}  // namespace kinematics
