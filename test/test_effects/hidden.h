// Machines with one more effect each, told alike to the laws and to the judge, who hides it by his
// own mechanics: a mount that moves under load, an eccentric sprocket, a chain out of plane in 3-D.
#pragma once

#include <Kinematics.h>
#include <math.h>

#include <Eigen/Geometry>
#include <functional>
#include <string>
#include <vector>

#include "params.h"
#include "reference/reference.h"

const double kChainWeight = 0.00137293, kSledWeight = 97.9, kCompliance = 5.17e-6;
const double kRadius = 63.5 / 6.283185307179586;

/// A machine with one more effect, told to the judge and to the laws.
struct Hidden {
  std::string name;
  std::vector<Sized> sizes;                       // settings of the laws
  std::function<void(reference::Machine&)> hide;  // the same in the judge's words
  double allowed;                                 // [mm] of chain
};

inline void PrintTo(const Hidden& hidden, std::ostream* out) { *out << hidden.name; }

const double kLean = 0.2617994;  // 15 degrees

inline std::vector<Hidden> everyEffect() {
  typedef reference::Machine M;
  return {
      {"nothing", {}, [](M&) {}, 0.005},
      {"motor_level", {{100, 6}}, [](M& m) { m.height_difference = 6; }, 0.005},
      {"frame_flex_inward",
       {{110, 0.007}},
       [](M& m) { m.left.inward = m.right.inward = 0.007; },
       0.006},
      {"frame_flex_downward",
       {{111, 0.02}},
       [](M& m) { m.left.downward = m.right.downward = 0.02; },
       0.006},
      {"frame_flex",
       {{110, 0.007}, {111, 0.02}},
       [](M& m) {
         m.left.inward = m.right.inward = 0.007;
         m.left.downward = m.right.downward = 0.02;
       },
       0.006},
      {"chain_plane", {{130, 1600}}, [](M& m) { m.plane_gap = 40; }, 0.005},
      {"chain_plane_far_off", {{130, 3600}}, [](M& m) { m.plane_gap = 60; }, 0.006},
      {"frame_lean",
       {{150, tan(kLean) * tan(kLean)}},
       [](M& m) {
         // The frame's weights are those along the sheet; the judge wants the whole.
         m.lean = kLean;
         m.sled_weight /= cos(kLean);
         m.left.weight /= cos(kLean);
         m.right.weight /= cos(kLean);
       },
       0.006},
      {"chain_pitch",
       {{180, 0.002}, {181, 0.0005}},
       [](M& m) { m.left.pitch = 0.002, m.right.pitch = 0.0005; },
       0.006},
      {"sprocket_runout",
       {{190, -0.06}, {191, -0.08}},
       [](M& m) {
         m.left.eccentricity = {0.08, 0.06};
       },
       0.008},
      {"chain_zero",
       {{200, 6.35}, {201, -2}},
       [](M& m) { m.left.zero = 6.35, m.right.zero = -2; },
       0.005},
  };
}

/// Where the motors are [mm].
struct Motors {
  double gap = 2978.4, height = 1072.6;  // apart, and above the middle of the sheet
};

inline kinematics::Machine<double> lawsWith(const std::vector<Sized>& sizes,
                                            const Motors& motors = {}) {
  const kinematics::Frame<double> frame = {motors.gap,
                                           motors.height,
                                           0,
                                           139.1,
                                           kRadius,
                                           kSledWeight,
                                           kChainWeight,
                                           kinematics::Feed::kOverTop};
  const double ratio = kChainWeight / kSledWeight;
  kinematics::EffectParams<double> effects =
      withEffects({{160, ratio * ratio / 24}, {170, kCompliance}});
  for (const Sized& one : sizes) effects.set(one.setting, one.size);
  return prepare(frame, effects);
}

inline reference::Machine judge(const Motors& motors = {}) {
  reference::Machine machine;
  machine.motor_gap = motors.gap;
  machine.motor_height = motors.height;
  machine.sprocket_radius = kRadius;
  machine.sled_weight = kSledWeight;
  for (reference::ChainSide* side : {&machine.left, &machine.right}) {
    side->weight = kChainWeight;
    side->compliance = kCompliance;
  }
  return machine;
}

/// Places [mm] all over the sheet.
inline std::vector<Eigen::Vector2d> sheetPlaces() {
  std::vector<Eigen::Vector2d> all;
  for (int i = 0; i <= 32; ++i)
    for (int j = 0; j <= 16; ++j) all.push_back({-1219.2 + 76.2 * i, -609.6 + 76.2 * j});
  return all;
}

/// The worse of both chains' differences [mm].
inline double worse(const kinematics::Chains<double>& ours, const Eigen::Vector2d& theirs) {
  return fmax(fabs(ours.left - theirs[0]), fabs(ours.right - theirs[1]));
}

/// Worst difference [mm] of the laws' lengths from the judge's over the sheet.
inline double worstOver(const kinematics::Machine<double>& laws, const reference::Machine& judge) {
  double found = 0;
  for (const Eigen::Vector2d& place : sheetPlaces()) {
    const reference::Hang truth = reference::hangAt(judge, place);
    if (!truth.solved) return 1e9;
    const kinematics::Point<double> at = {place.x(), place.y()};
    found = fmax(found, worse(inverse(laws, at).chains, truth.paid_out));
  }
  return found;
}

/// How far [mm] from a place the judge's sled hangs on the chains that the laws pay out for it.
inline double missedBy(const kinematics::Machine<double>& laws, const Eigen::Vector2d& place,
                       const Eigen::Vector2d& theirs) {
  const kinematics::Point<double> at = {place.x(), place.y()};
  const kinematics::Hanging<double> hanging = hang(laws, at, true);
  const kinematics::Chains<double> ours = inverse(laws, at).chains;
  const kinematics::Strand<double>&left = hanging.strand[0], &right = hanging.strand[1];
  Eigen::Matrix2d slopes;
  slopes << left.cosine, -left.sine, -right.cosine, -right.sine;
  return (slopes.inverse() * (Eigen::Vector2d(ours.left, ours.right) - theirs)).norm();
}

/// The worst of that [mm] over the sheet, under motors 2.9 to 3.7 m apart and 400 to 760 mm above
/// it. Under low motors far apart 1 mm of both chains is 4 mm at the bit.
inline double worstAtTheBit(const Hidden& hidden) {
  double found = 0;
  for (double gap : {2900.0, 3300.0, 3700.0})
    for (double offset : {400.0, 580.0, 760.0}) {
      const Motors motors = {gap, 609.6 + offset};
      const kinematics::Machine<double> laws = lawsWith(hidden.sizes, motors);
      reference::Machine machine = judge(motors);
      hidden.hide(machine);
      for (int i = 0; i <= 8; ++i)
        for (int j = 0; j <= 6; ++j) {
          const Eigen::Vector2d place(-1219.2 + 304.8 * i, -609.6 + 203.2 * j);
          const reference::Hang truth = reference::hangAt(machine, place);
          if (!truth.solved) return 1e9;
          found = fmax(found, missedBy(laws, place, truth.paid_out));
        }
    }
  return found;
}

/// Worst difference [mm] of lengths over the sheet for a sled that swings. The judge's ring hangs
/// where its chains pull; the sled carries its bit, 3 mm right of and 2 mm below the ring's centre,
/// turned by half the difference of both pulls' angles.
inline double worstSwing(const kinematics::Machine<double>& laws) {
  const Eigen::Vector2d bit_from_ring(3, -2);
  double found = 0;
  for (const Eigen::Vector2d& place : sheetPlaces()) {
    Eigen::Vector2d ring = place;
    reference::Hang truth;
    for (int round = 0; round < 6; ++round) {
      truth = reference::hangAt(judge(), ring);
      if (!truth.solved) return 1e9;
      // Pulls are on the ring: up and outward.
      const double left = atan2(truth.left.pull.y(), -truth.left.pull.x());
      const double right = atan2(truth.right.pull.y(), truth.right.pull.x());
      const Eigen::Rotation2Dd turned((right - left) / 2);
      ring = place + bit_from_ring - turned * bit_from_ring;
    }
    const kinematics::Point<double> at = {place.x(), place.y()};
    found = fmax(found, worse(inverse(laws, at).chains, truth.paid_out));
  }
  return found;
}
