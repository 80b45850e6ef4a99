// Machines for tests, over the whole range of machines that people build.
#pragma once

#include <Kinematics.h>

#include <ostream>
#include <string>
#include <vector>

/// A machine in plain numbers.
struct Tried {
  const char* name;
  double motor_gap = 2978.4;       // [mm]
  double motor_offset = 463;       // [mm] above the sheet's top edge
  double rotation_radius = 139.1;  // [mm]
  double sled_weight = 97.9;       // [N]
  bool over_top = true;
  double chain_weight = 0.00137293;  // [N/mm] 0.14 kg/m
  double compliance = 5.17e-6;       // [1/N]
  double left_pitch = 0.0012;
  double right_pitch = 0.0004;
};

const double kHalfWidth = 1219.2, kHalfHeight = 609.6;  // [mm] of the 8 x 4 ft sheet
const double kSprocketRadius = 63.5 / 6.283185307179586;

/// Spacing 2.9 to 3.7 m, offset 300 to 900, sled 60 to 150 N, ring 0 to 250 mm, both feeds.
inline std::vector<Tried> triedMachines() {
  std::vector<Tried> all(12);
  all[0].name = "Default";
  all[1].name = "OffBottom", all[1].over_top = false;
  all[2].name = "LightSled", all[2].sled_weight = 60;
  all[3].name = "HeavySled", all[3].sled_weight = 150;
  all[4].name = "NoRing", all[4].rotation_radius = 0;
  all[5].name = "WideRing", all[5].rotation_radius = 250;
  all[6].name = "NarrowLow", all[6].motor_gap = 2900, all[6].motor_offset = 300;
  all[7].name = "NarrowHigh", all[7].motor_gap = 2900, all[7].motor_offset = 900;
  all[8].name = "WideLow", all[8].motor_gap = 3700, all[8].motor_offset = 300;
  all[9].name = "WideHighOffBottom", all[9].motor_gap = 3700, all[9].motor_offset = 900,
  all[9].over_top = false;
  all[10].name = "WideLightWideRing", all[10].motor_gap = 3700, all[10].sled_weight = 60,
  all[10].rotation_radius = 250;
  all[11].name = "SoftChain", all[11].compliance = 1e-5;
  return all;
}

/// The machine in the form of lib/Kinematics. Sag with stretch, and pitch, are each multiplied by a
/// share; 0 gives the bare frame.
template <class Real>
kinematics::Machine<Real> lawsOf(const Tried& tried, double sag = 1, double pitch = 1) {
  kinematics::Frame<Real> frame;
  frame.motor_gap = Real(tried.motor_gap);
  frame.motor_height = Real(kHalfHeight + tried.motor_offset);
  frame.motor_center_x = Real(0);
  frame.rotation_radius = Real(tried.rotation_radius);
  frame.sprocket_radius = Real(kSprocketRadius);
  frame.sled_weight = Real(tried.sled_weight);
  frame.chain_weight = Real(tried.chain_weight);
  frame.feed = tried.over_top ? kinematics::Feed::kOverTop : kinematics::Feed::kOffBottom;
  const double ratio = tried.chain_weight / tried.sled_weight;
  kinematics::EffectParams<Real> effects = {};
  effects.set(160, Real(sag * ratio * ratio / 24));
  effects.set(170, Real(sag * tried.compliance));
  effects.set(180, Real(pitch * tried.left_pitch));
  effects.set(181, Real(pitch * tried.right_pitch));
  return prepare(frame, effects);
}

/// Test names from machine names.
struct NameOfTried {
  template <class Info>
  std::string operator()(const Info& info) const {
    return info.param.name;
  }
};

inline void PrintTo(const Tried& tried, std::ostream* out) { *out << tried.name; }
